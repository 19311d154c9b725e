// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "render/path_observer.h"
#include "render/ray_counts.h"
#include "render/region.h"
#include "render/scene.h"

// Follows one path through a scene: local light at each hit, then the mirror ray, until the bounces or the weight
// run out.
namespace tessera::render {

struct TraceOptions {
  std::uint32_t max_bounces = 5;
  Shade shade = Shade::phong;
};

/// A path ends where what it sees would weigh less. Below the normal numbers rounding may keep a weight alive for
/// ever: 0.9 times the smallest number is itself.
inline constexpr double kLeastWeight = std::numeric_limits<double>::min();

/// Radiance arriving at the origin of `camera_ray`: (1 - k) local + k mirrored at each surface, the background where
/// a ray leaves the scene or the bounces end. A convex combination throughout.
Rgb radiance_along(const Scene& scene, Ray camera_ray, const Region& region, const TraceOptions& options,
                   RayCounts& counts, std::span<PathObserver* const> observers = {});

}  // namespace tessera::render
