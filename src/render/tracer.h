// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "render/region.h"
#include "render/scene.h"

// Follows one path through a scene: local light at each hit, then the mirror ray, until the bounces or the weight
// run out.
namespace tessera::render {

/// Rays traced, by what they are for.
struct RayCounts {
  std::uint64_t primary = 0;
  std::uint64_t shadow = 0;
  std::uint64_t mirror = 0;

  std::uint64_t total() const noexcept { return primary + shadow + mirror; }
  RayCounts& operator+=(const RayCounts& o) noexcept {
    primary += o.primary;
    shadow += o.shadow;
    mirror += o.mirror;
    return *this;
  }
};

struct TraceOptions {
  std::uint32_t max_bounces = 5;
  Shade shade = Shade::phong;
};

/// Radiance arriving at the origin of `camera_ray`: (1 - k) local + k mirrored at each surface, the background where
/// a ray leaves the scene or the bounces end. A convex combination throughout.
Rgb radiance_along(const Scene& scene, Ray camera_ray, const Region& region, const TraceOptions& options,
                   RayCounts& counts) noexcept;

}  // namespace tessera::render
