// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/phong.h"
#include "render/plane.h"
#include "render/ray.h"
#include "render/region.h"
#include "render/scene.h"

// What a path finds where it meets a surface. Every way to follow paths computes it with these functions, so that all
// of them give the same bits.
namespace tessera::render {

inline Cell cell_of(const Scene& scene, const SurfacePoint& hit) noexcept {
  return scene.is_sphere(hit.surface) ? Cell::even : cell_at(scene.plane(hit.surface), hit.point);
}

inline const Material& material_of(const Scene& scene, const SurfacePoint& hit, Cell cell) noexcept {
  const MaterialIndex index =
      scene.is_sphere(hit.surface) ? scene.sphere(hit.surface).material : material_of(scene.plane(hit.surface), cell);
  return scene.material(index);
}

/// The hit's normal on the side that the path is on.
inline Vec3 facing_normal(const Scene& scene, const SurfacePoint& hit, const Region& region) noexcept {
  const bool outside = scene.is_sphere(hit.surface) ? !region.is_inside(hit.surface)
                                                    : region.side_of(index_of(hit.surface) - scene.sphere_count()) > 0;
  return outside ? hit.normal : -hit.normal;
}

/// Radiance from the environment alone.
inline Rgb ambient_radiance(const Scene& scene, const Material& material) noexcept {
  return scene.data().environment.ambient * (material.ambient * material.color);
}

/// Whether any light shows on a surface at all.
inline bool shows_light(const Material& material) noexcept {
  return material.diffuse != 0 || material.specular != 0;
}

/// The unit vector against an incoming ray, where it is needed: only a highlight asks for the viewer.
inline Vec3 to_viewer_of(const Material& material, const Vec3& incoming) noexcept {
  return material.specular > 0 ? normalized(-incoming) : Vec3{};
}

/// The way from a point to a light; for a directional one of any length.
inline Vec3 way_to(const Light& light, const Vec3& point) noexcept {
  return light.kind == LightKind::point ? light.vector - point : -light.vector;
}

/// The ray from a hit towards a light.
inline Ray ray_to_light(const SurfacePoint& hit, const Vec3& way) noexcept {
  return {hit.point, way, hit.surface, hit.normal};
}

/// The ray that a mirror at a hit sends on.
/// shapes:  normal is unit
inline Ray mirrored_ray(const SurfacePoint& hit, const Vec3& normal, const Vec3& incoming) noexcept {
  return {hit.point, incoming - 2 * dot(normal, incoming) * normal, hit.surface, hit.normal};
}

}  // namespace tessera::render
