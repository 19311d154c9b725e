// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "embree_triple.h"
#include "render/scene_data.h"

// A scene as Embree takes it: single precision, the spheres in its tree, the planes beside it.
namespace tessera::embree {

struct FloatSphere {
  float x, y, z, radius;
};

/// The points p with normal.p = offset.
struct FloatPlane {
  Triple<float> normal;
  float offset;
  std::uint32_t material;
};

/// What does not depend on the ray is multiplied out.
struct FloatMaterial {
  Triple<float> ambient;
  Triple<float> diffuse;
  float specular;
  float shininess;
  float reflection;
};

struct FloatLight {
  bool is_point;
  Triple<float> vector;  ///< its position, or the unit vector towards it
  Triple<float> color;
};

struct Scene {
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> tree;
  const FloatSphere* spheres = nullptr;  ///< Embree's own buffer
  std::vector<std::uint32_t> sphere_materials;
  std::vector<FloatPlane> planes;
  std::vector<FloatMaterial> materials;
  std::vector<FloatLight> lights;
  Triple<float> background;
  std::uint32_t max_bounces = 0;
  bool has_whole_shininess = true;
};

/// Fills Embree's buffers and builds its tree on the calling thread, with the quality meant for final renders.
/// throws:  std::runtime_error for what this program leaves out (checker boards, Blinn's highlights, several samples),
///          and with Embree's words
Scene build_scene(const render::SceneData& data);

}  // namespace tessera::embree
