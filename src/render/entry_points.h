// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "render/sphere.h"
#include "render/stream.h"

// Where rays meet spheres that they surely meet first: what is left to compute once all decisions are taken.
namespace tessera::render {

/// A ray by its number, and the sphere that it surely enters before it meets anything else.
struct SureEntry {
  std::uint32_t ray;
  SurfaceId sphere;
};

/// requires: is_squarable(ray.direction)
inline SurfacePoint entry_point(const Scene& scene, const Ray& ray, SurfaceId id) noexcept {
  const Sphere& sphere = scene.sphere(id);
  const Vec3 normal = sure_entry_normal(ray, norm_of(ray.direction), sphere.center, sphere.radius);
  return {id, sphere.center + sphere.radius * normal, normal};
}

/// points[entry.ray] = entry_point of that ray, for every entry; the other points stay as they are.
/// shapes:  points.size() = rays.size()
void entry_points(const Scene& scene, std::span<const RayInRegion> rays, std::span<const SureEntry> entries,
                  std::span<std::optional<SurfacePoint>> points) noexcept;

namespace avx2 {

void entry_points(const Scene& scene, std::span<const RayInRegion> rays, std::span<const SureEntry> entries,
                  std::span<std::optional<SurfacePoint>> points) noexcept;

}  // namespace avx2
}  // namespace tessera::render
