// SPDX-License-Identifier: BSD-3-Clause
#include "render/tracer.h"

#include "render/intersect.h"
#include "render/vertex.h"

namespace tessera::render {
namespace {

using Observers = std::span<PathObserver* const>;

/// Ambient light and every light that reaches the hit.
/// shapes:  normal is unit and faces against `incoming`
Rgb local_radiance(const Scene& scene, const Hit& hit, const Material& material, const Vec3& normal,
                   const Vec3& incoming, const Region& region, Shade shade, RayCounts& counts, Observers observers) {
  const Stage& data = scene.data();
  Rgb sum = ambient_radiance(scene, material);
  if (!shows_light(material)) return sum;

  const Vec3 to_viewer = to_viewer_of(material, incoming);
  for (std::size_t i = 0; i != data.lights.size(); ++i) {
    const Light& light = data.lights[i];
    const Vec3 way = way_to(light, hit.point);
    bool is_lit = dot(normal, way) > 0 && is_on_path_side(scene, i, hit.surface, region);
    if (is_lit) {
      ++counts.shadow;
      is_lit = !is_occluded(scene, ray_to_light(hit, way), i, region);
    }
    for (PathObserver* observer : observers) observer->on_light(i, is_lit);
    if (is_lit) sum += reflected_light(material, light.color, shade, normal, normalized(way), to_viewer);
  }
  return sum;
}

}  // namespace

Rgb radiance_along(const Scene& scene, Ray ray, const Region& region, const TraceOptions& options, RayCounts& counts,
                   Observers observers) {
  Rgb radiance;
  double weight = 1;
  ++counts.primary;
  for (std::uint32_t bounce = 0;; ++bounce) {
    const auto hit = nearest_hit(scene, ray, region);
    if (!hit) {
      for (PathObserver* observer : observers) observer->on_miss(ray, weight);
      break;
    }
    const Cell cell = cell_of(scene, *hit);
    const Material& material = material_of(scene, *hit, cell);
    const double k = material.reflection;
    const Vec3 normal = facing_normal(scene, *hit, region);
    for (PathObserver* observer : observers) observer->on_hit({ray, *hit, cell, normal, material, weight});
    if (k < 1) {
      radiance +=
          weight * (1 - k) *
          local_radiance(scene, *hit, material, normal, ray.direction, region, options.shade, counts, observers);
    }
    weight *= k;
    if (weight < kLeastWeight) return radiance;
    if (bounce == options.max_bounces) break;

    ray = mirrored_ray(*hit, normal, ray.direction);
    ++counts.mirror;
  }
  return radiance + weight * scene.data().environment.background;
}

}  // namespace tessera::render
