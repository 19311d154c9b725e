// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "render/vec3.h"

namespace tessera::render {

/// One surface of a scene: spheres come first, in their order, then the planes. Ties are won by the lowest.
enum class SurfaceId : std::uint32_t { none = std::numeric_limits<std::uint32_t>::max() };

constexpr SurfaceId surface_id(std::size_t index) noexcept {
  return static_cast<SurfaceId>(index);
}
constexpr std::size_t index_of(SurfaceId id) noexcept {
  return static_cast<std::size_t>(id);
}

/// A ray origin + t direction, t >= 0. It remembers the surface that it leaves: that one is treated by identity, so
/// no distance is ever compared with a small number to tell a surface from itself.
/// units:   t is in multiples of |direction|, which may have any length > 0
struct Ray {
  Vec3 origin;
  Vec3 direction;
  SurfaceId from = SurfaceId::none;
  Vec3 from_normal{};  ///< outward unit normal of the sphere left, at the origin
};

/// Where a ray meets a surface first.
struct SurfacePoint {
  SurfaceId surface = SurfaceId::none;
  Vec3 point;
  Vec3 normal;  ///< unit; a sphere's points outward, a plane's as the scene gives it
};

/// The same, and how far that is.
struct Hit : SurfacePoint {
  double t = 0;
};

}  // namespace tessera::render
