// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "render/ray.h"
#include "render/region.h"
#include "render/scene.h"

// The two questions that a tracer asks of a scene.
namespace tessera::render {

/// The first surface along `ray`, which runs in `region`, or nullopt where the ray leaves the scene. Equal
/// distances go to the lowest surface.
std::optional<Hit> nearest_hit(const Scene& scene, const Ray& ray, const Region& region) noexcept;

/// False for a light that is in the plane `surface` or behind it, which a rounded point of the plane may not tell; a
/// sphere leaves that to the normal.
inline bool is_on_path_side(const Scene& scene, std::size_t light, SurfaceId surface, const Region& region) noexcept {
  if (scene.is_sphere(surface)) return true;
  const std::size_t plane = index_of(surface) - scene.sphere_count();
  return scene.light_side(light, plane) == region.side_of(plane);
}

/// Whether light number `light` reaches no point of a path in `region`, wherever that is: one of the two is behind a
/// plane or within a sphere, and the other is not.
bool is_shut_off(const Scene& scene, std::size_t light, const Region& region) noexcept;

/// Whether a surface stands between the start of `to_light` and light number `light`.
/// units:   to_light.direction reaches a point light at t = 1; for a directional light any length > 0
bool is_occluded(const Scene& scene, const Ray& to_light, std::size_t light, const Region& region) noexcept;

}  // namespace tessera::render
