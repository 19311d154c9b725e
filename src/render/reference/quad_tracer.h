// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/ray_counts.h"
#include "render/reference/quad.h"
#include "render/scene_view.h"
#include "render/signature.h"

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
  QuadTracer(const SceneView& scene, const Vec3& eye, const Vec3& direction);

  std::optional<QuadHit> first_hit() const { return nearest(camera_ray_); }

  /// Radiance arriving at the eye, and on the way the path's decisions and its rays.
  QuadVec radiance(Signature& signature, RayCounts& counts) const;
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
  bool coincide(std::size_t a, std::size_t b) const;
  std::optional<QuadHit> nearest(const QuadRay& ray) const;
  bool is_blocked(const QuadRay& ray, const Light& light) const;
  bool is_on_surface(std::size_t surface, const QuadVec& point) const;
  bool ends_at_light(std::size_t surface, const QuadRay& ray, const QuadVec& light) const;
  bool is_lit(const QuadHit& hit, const Light& light, RayCounts& counts) const;
  QuadVec reflected_light(const QuadHit& hit, const Material& material, const QuadVec& to_viewer, Signature& signature,
                          RayCounts& counts) const;
  const Material& material_of(const QuadHit& hit, Cell cell) const;
  Cell cell_of(const QuadHit& hit) const;

  SceneView scene_;
  QuadRay camera_ray_;
  std::vector<bool> inside_;  ///< per sphere
  std::vector<int> side_;     ///< per plane
};

}  // namespace tessera::render::reference
