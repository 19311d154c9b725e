// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/ray.h"
#include "render/reference/quad.h"
#include "render/scene_data.h"

// The rendering model once more, in quad precision, by brute force, as a recursion: an oracle that
// shares no code with the renderer.
namespace tessera::render::reference {

struct QuadHit {
  std::size_t surface;  ///< spheres first, then planes
  Quad t;
  QuadVec point;
  QuadVec normal;  ///< facing the ray
};

class QuadTracer {
 public:
  /// The scene as a path from `eye` along `direction` meets it.
  QuadTracer(const SceneData& scene, const Vec3& eye, const Vec3& direction);

  std::optional<QuadHit> first_hit() const { return nearest({eye_, direction_, kNone, {}}); }
  QuadVec radiance() const { return radiance_along({eye_, direction_, kNone, {}}, scene_.image.max_bounces); }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  struct QuadRay {
    QuadVec origin;
    QuadVec direction;
    std::size_t from;
    QuadVec from_normal;  ///< facing the path
  };

  std::optional<Quad> distance_to(std::size_t surface, const QuadRay& ray) const;
  std::optional<QuadHit> nearest(const QuadRay& ray) const;
  bool is_blocked(const QuadRay& ray, const Light& light) const;
  QuadVec local_light(const QuadHit& hit, const QuadVec& to_viewer) const;
  QuadVec radiance_along(const QuadRay& ray, std::uint32_t bounces_left) const;
  const Material& material_of(const QuadHit& hit) const;

  const SceneData& scene_;
  QuadVec eye_;
  QuadVec direction_;
  std::vector<bool> inside_;  ///< per sphere
  std::vector<int> side_;     ///< per plane
};

}  // namespace tessera::render::reference
