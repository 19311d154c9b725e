// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "render/ray.h"
#include "render/region.h"
#include "render/scene.h"

// The two questions of intersect.h asked for many rays at a time, which is faster and gives the same answers.
namespace tessera::render {

/// A ray, and the part of space that it runs in.
struct RayInRegion {
  Ray ray;
  const Region* region;
};

/// What nearest_hit finds for every ray, without the distance.
/// shapes:  points.size() = rays.size()
void nearest_hits(const Scene& scene, std::span<const RayInRegion> rays, std::span<std::optional<SurfacePoint>> points);

/// is_occluded of every ray, all of them to the same light.
/// shapes:  occluded.size() = rays.size(); 1 where occluded, else 0
void occlusions(const Scene& scene, std::span<const RayInRegion> to_light, std::size_t light,
                std::span<std::uint8_t> occluded);

namespace avx2 {

void nearest_hits(const Scene& scene, std::span<const RayInRegion> rays, std::span<std::optional<SurfacePoint>> points);
void occlusions(const Scene& scene, std::span<const RayInRegion> to_light, std::size_t light,
                std::span<std::uint8_t> occluded);

}  // namespace avx2
}  // namespace tessera::render
