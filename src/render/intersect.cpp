// SPDX-License-Identifier: BSD-3-Clause
#include "render/intersect.h"

#include <cmath>
#include <limits>

#include "render/search.h"

namespace tessera::render {
namespace {

/// `ray` in another direction.
Ray along(Ray ray, const Vec3& direction) noexcept {
  ray.direction = direction;
  return ray;
}

/// Offers the search every sphere that its ray may meet.
template <class Search>
void search_along(const Scene& scene, Search& search) noexcept {
  scene.visit_along(search.ray(), search.inverse_length(), search.latest(),
                    [&](SurfaceId sphere) { return search.offer(sphere); });
}

}  // namespace

std::optional<Hit> nearest_hit(const Scene& scene, const Ray& ray, const Region& region) noexcept {
  if (!is_squarable(dot(ray.direction, ray.direction))) {
    int k = 0;
    auto hit = nearest_hit(scene, along(ray, rescaled(ray.direction, k)), region);
    if (hit) hit->t = std::ldexp(hit->t, k);
    return hit;
  }
  NearestSearch search(scene, ray, region);
  search_along(scene, search);
  return search.finish();
}

bool is_shut_off(const Scene& scene, std::size_t light_index, const Region& region) noexcept {
  // A plane blocks exactly if the light is on its other side.
  const std::size_t plane_count = scene.data().planes.size();
  for (std::size_t i = 0; i != plane_count; ++i) {
    if (scene.light_side(light_index, i) == -region.side_of(i)) return true;
  }
  // A sphere around the light blocks exactly if the path is outside of it, and the other way round.
  const Placement& placement = scene.light_placement(light_index);
  for (const SurfaceId id : placement.enclosing) {
    if (!region.is_inside(id)) return true;
  }
  for (const SurfaceId id : region.walls()) {
    if (!placement.encloses(id) && !placement.touches(id)) return true;
  }
  return false;
}

bool is_occluded(const Scene& scene, const Ray& to_light, std::size_t light_index, const Region& region) noexcept {
  if (is_shut_off(scene, light_index, region)) return true;

  int k = 0;
  const bool is_plain = is_squarable(dot(to_light.direction, to_light.direction));
  const Ray ray = is_plain ? to_light : along(to_light, rescaled(to_light.direction, k));
  const bool is_point = scene.data().lights[light_index].kind == LightKind::point;
  const double end = is_point ? std::ldexp(1.0, -k) : std::numeric_limits<double>::infinity();
  OcclusionSearch search(scene, ray, end, light_index, region);
  search_along(scene, search);
  return search.is_occluded();
}

}  // namespace tessera::render
