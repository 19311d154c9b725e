// SPDX-License-Identifier: BSD-3-Clause
#include "render/tile_renderer.h"

#include <cmath>

#include "render/encode.h"

namespace tessera::render {
namespace {

/// A ray costs some 0.05 to 1 us, a pause of the caller's up to 0.4 us, and a slice should stay near 0.1 ms. Counting
/// pixels instead would pause far too often in the sky and too rarely between mirrors.
constexpr std::uint64_t kSliceRays = 256;

}  // namespace

TileRenderer::TileRenderer(const Scene& scene, PixelFormat format)
    : scene_(scene),
      format_(format),
      camera_(scene.data().camera.value(), scene.data().image.width, scene.data().image.height),
      trace_options_{scene.data().image.max_bounces, scene.data().image.shade},
      grid_(static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(scene.data().image.samples))))) {
  if (camera_.projection() != Projection::perspective) return;
  const Ray center = camera_.through(0, 0);
  eye_placement_ = scene.placement_of(center.origin);
  if (eye_placement_.touching.empty()) region_.emplace(scene, eye_placement_, center.origin, center.direction);
}

RayCounts TileRenderer::render(const Rect& tile, std::span<std::byte> pixels,
                               const std::function<void()>& between_slices) const {
  RayCounts counts;
  std::byte* out = pixels.data();
  std::uint64_t slice_end = kSliceRays;
  for (std::uint32_t y = tile.y; y != tile.y + tile.height; ++y) {
    for (std::uint32_t x = tile.x; x != tile.x + tile.width; ++x) {
      encode_pixel(pixel(x, y, counts), format_, scene_.data().image.transfer, out);
      out += bytes_per_pixel(format_);
      if (counts.total() >= slice_end) {
        between_slices();
        slice_end = counts.total() + kSliceRays;
      }
    }
  }
  return counts;
}

Rgb TileRenderer::pixel(std::uint32_t x, std::uint32_t y, RayCounts& counts) const {
  Rgb sum;
  for (std::uint32_t j = 0; j != grid_; ++j) {
    for (std::uint32_t i = 0; i != grid_; ++i) sum += sample(x + (i + 0.5) / grid_, y + (j + 0.5) / grid_, counts);
  }
  return sum * (1.0 / (static_cast<double>(grid_) * grid_));
}

Rgb TileRenderer::sample(double x, double y, RayCounts& counts) const {
  const Ray ray = camera_.through(x, y);
  if (region_) return radiance_along(scene_, ray, *region_, trace_options_, counts);
  const bool perspective = camera_.projection() == Projection::perspective;
  const Region region(scene_, perspective ? eye_placement_ : scene_.placement_of(ray.origin), ray.origin,
                      ray.direction);
  return radiance_along(scene_, ray, region, trace_options_, counts);
}

}  // namespace tessera::render
