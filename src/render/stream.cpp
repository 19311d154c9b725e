// SPDX-License-Identifier: BSD-3-Clause
#include "render/stream.h"

#include "render/intersect.h"

namespace tessera::render {

void nearest_hits(const Scene& scene, std::span<const RayInRegion> rays,
                  std::span<std::optional<SurfacePoint>> points) {
  if (scene.kernel() == Kernel::avx2) return avx2::nearest_hits(scene, rays, points);
  for (std::size_t i = 0; i != rays.size(); ++i) points[i] = nearest_hit(scene, rays[i].ray, *rays[i].region);
}

void occlusions(const Scene& scene, std::span<const RayInRegion> to_light, std::size_t light,
                std::span<std::uint8_t> occluded) {
  if (scene.kernel() == Kernel::avx2) return avx2::occlusions(scene, to_light, light, occluded);
  for (std::size_t i = 0; i != to_light.size(); ++i) {
    occluded[i] = is_occluded(scene, to_light[i].ray, light, *to_light[i].region);
  }
}

}  // namespace tessera::render
