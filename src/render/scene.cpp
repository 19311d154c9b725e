// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "render/bvh_build.h"
#include "render/plane.h"
#include "render/sphere.h"

namespace tessera::render {
namespace {

void require_one_of(std::span<const Material> materials, MaterialIndex index) {
  if (static_cast<std::size_t>(index) < materials.size()) return;
  throw std::invalid_argument("a plane's material is number " + std::to_string(static_cast<std::size_t>(index)) +
                              " of " + std::to_string(materials.size()));
}

}  // namespace

Scene::Scene(SceneData data, Kernel kernel)
    : spheres_(std::move(data.spheres)),
      materials_(std::move(data.materials)),
      data_(std::move(static_cast<Stage&>(data))),
      kernel_(runnable(kernel)),
      bvh_(kernel_ == Kernel::brute ? Bvh() : build_bvh(spheres_)) {
  prepare();
}

Scene::Scene(SharedArray<Sphere> spheres, SharedArray<Material> materials, Stage data, Kernel kernel, Bvh tree)
    : spheres_(std::move(spheres)),
      materials_(std::move(materials)),
      data_(std::move(data)),
      kernel_(runnable(kernel)),
      bvh_(std::move(tree)) {
  prepare();
}

void Scene::prepare() {
  const Box bounds = hittable_bounds(spheres_);
  if (!bounds.is_empty()) {
    middle_ = 0.5 * (bounds.lo + bounds.hi);
    reach_ = bounds.reach_from(middle_);
  }
  for (const Plane& plane : data_.planes) {
    require_one_of(view().materials, plane.material);
    if (plane.checker) require_one_of(view().materials, plane.checker->material);
    plane_normals_.push_back(normalized(plane.normal));
    plane_looks_.push_back({sum_of_sizes(plane.normal), sum_of_sizes(plane.point)});
  }
  for (std::size_t i = 0; i != data_.planes.size(); ++i) {
    const auto is_same = [&](std::size_t other) { return coincide(data_.planes[other], data_.planes[i]); };
    if (std::none_of(visible_planes_.begin(), visible_planes_.end(), is_same)) visible_planes_.push_back(i);
  }
  for (const Light& light : data_.lights) {
    const bool is_point = light.kind == LightKind::point;
    light_placements_.push_back(is_point ? placement_of(light.vector) : Placement{});
    for (const Plane& plane : data_.planes) {
      const int side = is_point ? side_of(light.vector, plane) : -heading_of(light.vector, plane);
      light_sides_.push_back(static_cast<std::int8_t>(side));
    }
  }
}

Placement Scene::placement_of(const Vec3& point) const {
  Placement placement;
  const auto holds_point = [&](const Box& box) { return box.contains(point); };
  visit_where(holds_point, [&](SurfaceId id) {
    const int side = side_of(point, sphere(id).center, sphere(id).radius);
    if (side < 0) placement.enclosing.push_back(id);
    if (side == 0) placement.touching.push_back(id);
  });
  for (std::size_t i = 0; i != data_.planes.size(); ++i) {
    if (side_of(point, data_.planes[i]) == 0) placement.touching.push_back(plane_id(i));
  }
  std::sort(placement.enclosing.begin(), placement.enclosing.end());
  std::sort(placement.touching.begin(), placement.touching.end());
  return placement;
}

}  // namespace tessera::render
