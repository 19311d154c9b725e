// SPDX-License-Identifier: BSD-3-Clause
#include "render/entry_points.h"

namespace tessera::render {

void entry_points(const Scene& scene, std::span<const RayInRegion> rays, std::span<const SureEntry> entries,
                  std::span<std::optional<SurfacePoint>> points) noexcept {
  if (scene.kernel() == Kernel::avx2) return avx2::entry_points(scene, rays, entries, points);
  for (const auto& [ray, sphere] : entries) points[ray] = entry_point(scene, rays[ray].ray, sphere);
}

}  // namespace tessera::render
