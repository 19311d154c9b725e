// SPDX-License-Identifier: BSD-3-Clause
#include "render/tracer.h"

#include <limits>

#include "render/intersect.h"
#include "render/phong.h"
#include "render/plane.h"

namespace tessera::render {
namespace {

using Observers = std::span<PathObserver* const>;

Cell cell_of(const Scene& scene, const Hit& hit) noexcept {
  return scene.is_sphere(hit.surface) ? Cell::even : cell_at(scene.plane(hit.surface), hit.point);
}

const Material& material_of(const Scene& scene, const Hit& hit, Cell cell) noexcept {
  const MaterialIndex index =
      scene.is_sphere(hit.surface) ? scene.sphere(hit.surface).material : material_of(scene.plane(hit.surface), cell);
  return scene.data().materials[static_cast<std::size_t>(index)];
}

/// Ambient light and every light that reaches the hit.
/// shapes:  normal is unit and faces against `incoming`
Rgb local_radiance(const Scene& scene, const Hit& hit, const Material& material, const Vec3& normal,
                   const Vec3& incoming, const Region& region, Shade shade, RayCounts& counts, Observers observers) {
  const SceneData& data = scene.data();
  Rgb sum = data.environment.ambient * (material.ambient * material.color);
  if (material.diffuse == 0 && material.specular == 0) return sum;

  // Only a highlight asks for the viewer.
  const Vec3 to_viewer = material.specular > 0 ? normalized(-incoming) : Vec3{};
  for (std::size_t i = 0; i != data.lights.size(); ++i) {
    const Light& light = data.lights[i];
    const Vec3 reach = light.kind == LightKind::point ? light.vector - hit.point : -light.vector;
    bool is_lit = dot(normal, reach) > 0 && is_on_path_side(scene, i, hit.surface, region);
    if (is_lit) {
      ++counts.shadow;
      is_lit = !is_occluded(scene, {hit.point, reach, hit.surface, hit.normal}, i, region);
    }
    for (PathObserver* observer : observers) observer->on_light(i, is_lit);
    if (is_lit) sum += reflected_light(material, light.color, shade, normal, normalized(reach), to_viewer);
  }
  return sum;
}

/// The hit's normal on the side that the path is on.
Vec3 facing_normal(const Scene& scene, const Hit& hit, const Region& region) noexcept {
  const bool outside = scene.is_sphere(hit.surface) ? !region.is_inside(hit.surface)
                                                    : region.side_of(index_of(hit.surface) - scene.sphere_count()) > 0;
  return outside ? hit.normal : -hit.normal;
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
    // Below the normal numbers rounding may keep a weight alive for ever: 0.9 times the smallest number is itself.
    if (weight < std::numeric_limits<double>::min()) return radiance;
    if (bounce == options.max_bounces) break;

    const Vec3 mirrored = ray.direction - 2 * dot(normal, ray.direction) * normal;
    ray = {hit->point, mirrored, hit->surface, hit->normal};
    ++counts.mirror;
  }
  return radiance + weight * scene.data().environment.background;
}

}  // namespace tessera::render
