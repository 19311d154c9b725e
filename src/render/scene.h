// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "render/bvh.h"
#include "render/kernel.h"
#include "render/plane.h"
#include "render/scene_data.h"
#include "render/scene_view.h"
#include "render/shared_array.h"

// A scene made ready for tracing.
namespace tessera::render {

/// The surfaces that matter at one point: the spheres around it, and all surfaces that go through it.
struct Placement {
  std::vector<SurfaceId> enclosing;  ///< spheres that strictly contain the point, ascending
  std::vector<SurfaceId> touching;   ///< surfaces exactly at the point, ascending

  bool encloses(SurfaceId sphere) const noexcept { return holds(enclosing, sphere); }
  bool touches(SurfaceId surface) const noexcept { return holds(touching, surface); }

  /// Of an ascending list, which is mostly empty.
  static bool holds(const std::vector<SurfaceId>& ids, SurfaceId id) noexcept {
    return !ids.empty() && std::binary_search(ids.begin(), ids.end(), id);
  }
};

class Scene {
 public:
  /// throws:  std::invalid_argument for a kernel that this machine cannot run, a plane without its material
  Scene(SceneData data, Kernel kernel);

  /// Of parts that others may look at as well; `tree` is over the spheres, or empty where the kernel needs none.
  Scene(SharedArray<Sphere> spheres, SharedArray<Material> materials, Stage data, Kernel kernel, Bvh tree);

  /// All but the spheres and the materials.
  const Stage& data() const noexcept { return data_; }
  std::span<const Sphere> spheres() const noexcept { return spheres_; }
  SceneView view() const noexcept { return {spheres_, materials_, data_}; }
  Kernel kernel() const noexcept { return kernel_; }
  const Bvh& bvh() const noexcept { return bvh_; }

  std::size_t sphere_count() const noexcept { return spheres_.size(); }
  bool is_sphere(SurfaceId id) const noexcept { return index_of(id) < sphere_count(); }
  const Sphere& sphere(SurfaceId id) const noexcept { return spheres_[index_of(id)]; }
  const Plane& plane(SurfaceId id) const noexcept { return data_.planes[index_of(id) - sphere_count()]; }
  const Material& material(MaterialIndex index) const noexcept { return materials_[static_cast<std::size_t>(index)]; }
  const Vec3& unit_normal(SurfaceId plane) const noexcept { return plane_normals_[index_of(plane) - sphere_count()]; }
  const PlaneLookBounds& plane_look(std::size_t plane) const noexcept { return plane_looks_[plane]; }
  SurfaceId plane_id(std::size_t plane) const noexcept { return surface_id(sphere_count() + plane); }

  /// The planes that can be seen: of those that coincide the first alone.
  const std::vector<std::size_t>& visible_planes() const noexcept { return visible_planes_; }

  /// Of two spheres.
  bool are_coincident(SurfaceId a, SurfaceId b) const noexcept {
    return is_sphere(a) && is_sphere(b) && coincide(sphere(a), sphere(b));
  }

  /// The surfaces that matter at a point light; none for a directional one.
  const Placement& light_placement(std::size_t light) const noexcept { return light_placements_[light]; }

  /// The side of a plane that a light is on or shines from: -1 behind, 0 on (along), +1 before it.
  int light_side(std::size_t light, std::size_t plane) const noexcept {
    return light_sides_[light * data_.planes.size() + plane];
  }

  Placement placement_of(const Vec3& point) const;

  /// At least |C - point| + r for every sphere that can be hit, but for a few roundings.
  double reach_from(const Vec3& point) const noexcept {
    const Vec3 way = point - middle_;
    return std::abs(way.x) + std::abs(way.y) + std::abs(way.z) + reach_;
  }

  /// Calls visit(sphere) for every sphere that the ray may meet before `t_max`; see Bvh::visit_along.
  template <class Visit>
  void visit_along(const Ray& ray, double inverse_length, const double& t_max, Visit&& visit) const {
    if (kernel_ != Kernel::brute) return bvh_.visit_along(ray, inverse_length, t_max, visit);
    for (std::size_t i = 0; i != spheres_.size(); ++i) {
      if (spheres_[i].radius > 0 && visit(surface_id(i))) return;
    }
  }

  /// Calls visit(sphere) for every sphere that may lie in a region of space that `meets(box)` knows.
  template <class Meets, class Visit>
  void visit_where(Meets&& meets, Visit&& visit) const {
    if (kernel_ != Kernel::brute) return bvh_.visit_where(meets, visit);
    for (std::size_t i = 0; i != spheres_.size(); ++i) {
      if (spheres_[i].radius > 0) visit(surface_id(i));
    }
  }

 private:
  /// Derives the rest.
  void prepare();

  SharedArray<Sphere> spheres_;
  SharedArray<Material> materials_;
  Stage data_;
  Kernel kernel_;
  Bvh bvh_;
  Vec3 middle_;       ///< of the box around all spheres that can be hit
  double reach_ = 0;  ///< from there to a corner, summed over the axes
  std::vector<std::size_t> visible_planes_;
  std::vector<Vec3> plane_normals_;  ///< of length 1
  std::vector<PlaneLookBounds> plane_looks_;
  std::vector<Placement> light_placements_;
  std::vector<std::int8_t> light_sides_;  ///< lights x planes
};

}  // namespace tessera::render
