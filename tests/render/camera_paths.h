// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "render/scene_fixture.h"
#include "render/wavefront.h"

namespace tessera::render::test {

/// Camera rays, each with a region of its own.
struct CameraPaths {
  std::deque<Region> regions;
  std::vector<RayInRegion> rays;

  void add(const Ray& ray, const Region& region) {
    regions.push_back(region);
    rays.push_back({ray, &regions.back()});
  }
  void add(const Scene& scene, const Vec3& eye, const Vec3& direction) {
    add({.origin = eye, .direction = direction}, region_at(scene, eye, direction));
  }
};

/// What paths show that are followed together, by the scene's own kernel and settings.
inline std::vector<Rgb> seen_together(const Scene& scene, std::span<const RayInRegion> rays) {
  std::vector<Rgb> seen(rays.size());
  RayCounts counts;
  Wavefront(scene, {scene.data().image.max_bounces, scene.data().image.shade}).trace(rays, seen, counts, [] {});
  return seen;
}

/// What they found first.
inline std::vector<std::optional<SurfacePoint>> hits_together(const Scene& scene, std::span<const RayInRegion> rays) {
  std::vector<std::optional<SurfacePoint>> hits(rays.size());
  nearest_hits(scene, rays, hits);
  return hits;
}

}  // namespace tessera::render::test
