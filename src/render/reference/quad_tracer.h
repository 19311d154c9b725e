// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/reference/quad.h"
#include "render/scene_data.h"

// The rendering model once more, in quad precision, by brute force, with the textbook's formulas: what the renderer is
// measured against. It takes the camera ray as the renderer rounds it, and shares no code with how that is traced.
namespace tessera::render::reference {

struct QuadHit {
  std::size_t surface;  ///< spheres first, then planes
  Quad t;
  QuadVec point;
  QuadVec normal;  ///< unit, facing the ray
};

class QuadTracer {
 public:
  /// The scene as a path from `eye` along `direction` meets it. It must outlive the tracer.
  QuadTracer(const SceneData& scene, const Vec3& eye, const Vec3& direction);

  std::optional<QuadHit> first_hit() const { return nearest(camera_ray_); }

  /// Radiance arriving at the eye.
  QuadVec radiance() const;

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  struct QuadRay {
    QuadVec origin;
    QuadVec direction;
    std::size_t from;     ///< the surface left
    QuadVec from_normal;  ///< facing the path
  };

  std::optional<Quad> distance_to(std::size_t surface, const QuadRay& ray) const;
  std::optional<QuadHit> nearest(const QuadRay& ray) const;
  bool is_blocked(const QuadRay& ray, const Light& light) const;
  QuadVec local_light(const QuadHit& hit, const Material& material, const QuadVec& to_viewer) const;
  QuadVec light_from(const Light& light, const QuadHit& hit, const Material& material, const QuadVec& to_viewer) const;
  const Material& material_of(const QuadHit& hit) const;
  bool is_odd_cell(const Plane& plane, const QuadVec& point) const;

  const SceneData& scene_;
  QuadRay camera_ray_;
  std::vector<bool> inside_;  ///< per sphere
  std::vector<int> side_;     ///< per plane
};

}  // namespace tessera::render::reference
