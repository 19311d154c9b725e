// SPDX-License-Identifier: BSD-3-Clause
#include "render/tile_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/encode.h"
#include "render/exact.h"
#include "render/path_error.h"
#include "render/reference/quad_tracer.h"
#include "render/signature_observer.h"

namespace tessera::render {
namespace {

/// A ray costs some 0.05 to 1 us, a pause of the caller's up to 0.4 us, and a slice should stay near 0.1 ms. Counting
/// pixels instead would pause far too often in the sky and too rarely between mirrors.
constexpr std::uint64_t kSliceRays = 256;

/// A ray in quad precision takes more than a slice.
std::uint64_t slice_rays_of(Tracer tracer) {
  return tracer == Tracer::reference ? 1 : kSliceRays;
}

/// The next float above what may have been rounded down.
float rounded_up(double error) {
  return std::nextafter(static_cast<float>(error), std::numeric_limits<float>::infinity());
}

Rgb rounded(const reference::QuadVec& color) {
  return {static_cast<double>(color.x), static_cast<double>(color.y), static_cast<double>(color.z)};
}

}  // namespace

TileRenderer::TileRenderer(const Scene& scene, PixelFormat format, Tracer tracer)
    : scene_(scene),
      format_(format),
      tracer_(tracer),
      camera_(scene.data().camera.value(), scene.data().image.width, scene.data().image.height),
      trace_options_{scene.data().image.max_bounces, scene.data().image.shade},
      grid_(static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(scene.data().image.samples))))) {
  if (camera_.projection() != Projection::perspective) return;
  const Ray center = camera_.through(0, 0);
  eye_placement_ = scene.placement_of(center.origin);
  if (eye_placement_.touching.empty()) region_.emplace(scene, eye_placement_, center.origin, center.direction);
}

RayCounts TileRenderer::render(const Rect& tile, const TilePixels& out,
                               const std::function<void()>& between_slices) const {
  RayCounts counts;
  std::byte* color = out.colors.data();
  std::size_t index = 0;
  const std::uint64_t slice_rays = slice_rays_of(tracer_);
  std::uint64_t slice_end = slice_rays;
  for (std::uint32_t y = tile.y; y != tile.y + tile.height; ++y) {
    for (std::uint32_t x = tile.x; x != tile.x + tile.width; ++x, ++index) {
      const Pixel seen = pixel(x, y, out, counts);
      encode_pixel(seen.color, format_, scene_.data().image.transfer, color);
      color += bytes_per_pixel(format_);
      if (!out.signatures.empty()) out.signatures[index] = seen.signature;
      if (!out.errors.empty()) out.errors[index] = rounded_up(seen.error);
      if (counts.total() >= slice_end) {
        between_slices();
        slice_end = counts.total() + slice_rays;
      }
    }
  }
  return counts;
}

TileRenderer::Pixel TileRenderer::pixel(std::uint32_t x, std::uint32_t y, const TilePixels& asked,
                                        RayCounts& counts) const {
  Pixel pixel;
  for (std::uint32_t j = 0; j != grid_; ++j) {
    for (std::uint32_t i = 0; i != grid_; ++i) {
      add_sample(x + (i + 0.5) / grid_, y + (j + 0.5) / grid_, asked, pixel, counts);
    }
  }
  const double samples = static_cast<double>(grid_) * grid_;
  pixel.color = pixel.color * (1 / samples);
  // The sum rounds once a sample, its share of the pixel twice more.
  const double brightest = std::max({pixel.color.r, pixel.color.g, pixel.color.b});
  if (samples > 1) pixel.error = pixel.error / samples + (samples + 4) * kUnitRoundoff * brightest;
  return pixel;
}

void TileRenderer::add_sample(double x, double y, const TilePixels& asked, Pixel& pixel, RayCounts& counts) const {
  const Ray ray = camera_.through(x, y);
  if (tracer_ == Tracer::reference) {
    const reference::QuadTracer tracer(scene_.data(), ray.origin, ray.direction);
    pixel.color += rounded(tracer.radiance(pixel.signature, counts));
    return;
  }
  if (region_) {
    pixel.color += traced(ray, *region_, asked, pixel, counts);
    return;
  }
  const bool perspective = camera_.projection() == Projection::perspective;
  const Region region(scene_, perspective ? eye_placement_ : scene_.placement_of(ray.origin), ray.origin,
                      ray.direction);
  pixel.color += traced(ray, region, asked, pixel, counts);
}

Rgb TileRenderer::traced(const Ray& ray, const Region& region, const TilePixels& asked, Pixel& pixel,
                         RayCounts& counts) const {
  if (asked.signatures.empty() && asked.errors.empty()) {
    return radiance_along(scene_, ray, region, trace_options_, counts);
  }
  SignatureObserver signature(pixel.signature);
  PathError error(scene_, region, trace_options_.shade);
  PathObserver* const both[] = {&signature, &error};
  const std::span<PathObserver* const> observers = both;
  const Rgb color = radiance_along(scene_, ray, region, trace_options_, counts,
                                   asked.errors.empty() ? observers.first(1) : observers);
  if (!asked.errors.empty()) pixel.error += error.bound();
  return color;
}

}  // namespace tessera::render
