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
#include "render/tile.h"
#include "render/wavefront.h"

namespace tessera::render {
namespace {

/// A ray costs some 0.05 to 1 us, a pause of the caller's up to 0.4 us, and a slice should stay near 0.1 ms. Counting
/// pixels instead would pause far too often in the sky and too rarely between mirrors.
constexpr std::uint64_t kSliceRays = 256;

/// Pixels that are seen together: enough rays to overlap, few enough for the cache.
constexpr std::uint32_t kBlockSide = 16;
constexpr std::size_t kPathsTogether = std::size_t{kBlockSide} * kBlockSide;

/// The same of rays whose first spheres are drawn.
constexpr std::uint32_t kRasterSide = avx2::Raster::kSide;
constexpr std::size_t kRasterRays = std::size_t{kRasterSide} * kRasterSide;
/// Blocks with nothing to see take a thirtieth of a slice.
constexpr std::uint32_t kQuietBlocks = 16;

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
  wavefront_ = std::make_shared<Wavefront>(scene_, trace_options_);
  if (camera_.projection() != Projection::perspective) return;
  const Ray center = camera_.through(0, 0);
  eye_placement_ = scene.placement_of(center.origin);
  if (eye_placement_.touching.empty()) region_.emplace(scene, eye_placement_, center.origin, center.direction);
}

RayCounts TileRenderer::render(const Rect& tile, const TilePixels& out,
                               const std::function<void()>& between_slices) const {
  const bool colors_alone = out.signatures.empty() && out.errors.empty();
  if (tracer_ == Tracer::reference || !colors_alone) return render_one_by_one(tile, out, between_slices);
  RayCounts counts;
  std::optional<avx2::Raster> raster;
  if (can_draw()) raster.emplace(scene_, camera_, *region_);
  std::uint32_t quiet_blocks = 0;
  const std::uint32_t side = raster ? kRasterSide / grid_ : kBlockSide;
  for (const Rect& block : tile_grid(tile, side, side)) {
    const bool is_drawn = raster && drawing_.pays();
    if (raster && !is_drawn) drawing_.skip(block.pixels() * grid_ * grid_);
    const std::vector<Rgb> pixels =
        is_drawn ? drawn_pixels(block, *raster, *wavefront_, counts, between_slices, quiet_blocks)
                 : block_pixels(block, *wavefront_, counts, between_slices);
    const Rgb* pixel = pixels.data();
    for (std::uint32_t y = block.y - tile.y; y != block.y - tile.y + block.height; ++y) {
      const std::size_t first = std::size_t{y} * tile.width + (block.x - tile.x);
      std::byte* color = out.colors.data() + first * bytes_per_pixel(format_);
      for (std::uint32_t x = 0; x != block.width; ++x, color += bytes_per_pixel(format_)) {
        encode_pixel(*pixel++, format_, scene_.data().image.transfer, color);
      }
    }
  }
  return counts;
}

std::vector<Rgb> TileRenderer::block_pixels(const Rect& block, Wavefront& wavefront, RayCounts& counts,
                                            const std::function<void()>& between_slices) const {
  std::vector<Rgb> pixels(block.pixels());
  std::vector<RayInRegion> rays;
  std::vector<std::size_t> pixel_of_ray;
  std::vector<Rgb> radiances(kPathsTogether);
  std::vector<Region> regions;  // where each ray has one of its own
  regions.reserve(region_ ? 0 : kPathsTogether);
  const auto trace = [&] {
    const auto seen = std::span(radiances).first(rays.size());
    wavefront.trace(rays, seen, counts, between_slices);
    for (std::size_t i = 0; i != rays.size(); ++i) pixels[pixel_of_ray[i]] += seen[i];
    rays.clear();
    pixel_of_ray.clear();
    regions.clear();
  };
  for (std::size_t pixel = 0; pixel != pixels.size(); ++pixel) {
    const auto x = block.x + static_cast<std::uint32_t>(pixel % block.width);
    const auto y = block.y + static_cast<std::uint32_t>(pixel / block.width);
    for (std::uint32_t sample = 0; sample != grid_ * grid_; ++sample) {
      const Ray ray = camera_ray(x, y, sample);
      rays.push_back({ray, region_ ? &*region_ : &regions.emplace_back(region_of(ray))});
      pixel_of_ray.push_back(pixel);
      if (rays.size() == kPathsTogether) trace();
    }
  }
  trace();
  for (Rgb& pixel : pixels) pixel = mean_of_samples(pixel);
  return pixels;
}

bool TileRenderer::can_draw() const noexcept {
  return scene_.kernel() == Kernel::avx2 && region_ && grid_ <= kRasterSide;
}

std::vector<Rgb> TileRenderer::drawn_pixels(const Rect& block, avx2::Raster& raster, Wavefront& wavefront,
                                            RayCounts& counts, const std::function<void()>& between_slices,
                                            std::uint32_t& quiet_blocks) const {
  std::array<double, kRasterSide> x;
  std::array<double, kRasterSide> y;
  for (std::uint32_t i = 0; i != block.width * grid_; ++i) x[i] = sample_place(block.x + i / grid_, i % grid_);
  for (std::uint32_t i = 0; i != block.height * grid_; ++i) y[i] = sample_place(block.y + i / grid_, i % grid_);
  const bool any =
      raster.draw(std::span(x).first(block.width * grid_), std::span(y).first(block.height * grid_), drawing_);

  // A path that meets nothing ends here, as it does in a wavefront.
  const bool is_sky = scene_.visible_planes().empty() && region_->walls().empty();
  Rgb sky;
  sky += 1.0 * scene_.data().environment.background;
  std::array<Rgb, kRasterRays> radiances;
  std::array<SurfaceId, kRasterRays> first_spheres;
  std::array<std::uint32_t, kRasterRays> sample_of_ray;
  std::vector<RayInRegion> rays;
  const std::uint32_t samples = grid_ * grid_;
  if (any || !is_sky) rays.reserve(block.pixels() * samples);
  std::uint32_t count = 0;
  const auto add_pixel = [&](std::uint32_t column, std::uint32_t row) {
    for (std::uint32_t sample = 0; sample != samples; ++sample, ++count) {
      const SurfaceId sphere =
          any ? raster.first_sphere(column * grid_ + sample % grid_, row * grid_ + sample / grid_) : SurfaceId::none;
      if (sphere == SurfaceId::none && is_sky) {
        radiances[count] = sky;
        continue;
      }
      first_spheres[rays.size()] = sphere;
      sample_of_ray[rays.size()] = count;
      rays.push_back({camera_ray(block.x + column, block.y + row, sample), &*region_});
    }
  };
  for (std::uint32_t row = 0; row != block.height; ++row) {
    for (std::uint32_t column = 0; column != block.width; ++column) add_pixel(column, row);
  }
  counts.primary += count - rays.size();
  if (!rays.empty()) {
    std::array<Rgb, kRasterRays> seen;
    wavefront.trace(rays, std::span(seen).first(rays.size()), counts, between_slices,
                    std::span(first_spheres).first(rays.size()));
    for (std::size_t ray = 0; ray != rays.size(); ++ray) radiances[sample_of_ray[ray]] = seen[ray];
  } else if (++quiet_blocks % kQuietBlocks == 0) {
    between_slices();
  }

  std::vector<Rgb> pixels(block.pixels());
  const Rgb* radiance = radiances.data();
  for (Rgb& pixel : pixels) {
    for (std::uint32_t sample = 0; sample != samples; ++sample) pixel += *radiance++;
    pixel = mean_of_samples(pixel);
  }
  return pixels;
}

RayCounts TileRenderer::render_one_by_one(const Rect& tile, const TilePixels& out,
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
  for (std::uint32_t sample = 0; sample != grid_ * grid_; ++sample) {
    add_sample(camera_ray(x, y, sample), asked, pixel, counts);
  }
  pixel.color = mean_of_samples(pixel.color);
  // The sum rounds once a sample, its share of the pixel twice more.
  const double samples = static_cast<double>(grid_) * grid_;
  const double brightest = std::max({pixel.color.r, pixel.color.g, pixel.color.b});
  if (samples > 1) pixel.error = pixel.error / samples + (samples + 4) * kUnitRoundoff * brightest;
  return pixel;
}

Ray TileRenderer::camera_ray(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const noexcept {
  return camera_.through(sample_place(x, sample % grid_), sample_place(y, sample / grid_));
}

Region TileRenderer::region_of(const Ray& ray) const {
  const bool perspective = camera_.projection() == Projection::perspective;
  return {scene_, perspective ? eye_placement_ : scene_.placement_of(ray.origin), ray.origin, ray.direction};
}

Rgb TileRenderer::mean_of_samples(const Rgb& sum) const noexcept {
  return sum * (1 / (static_cast<double>(grid_) * grid_));
}

void TileRenderer::add_sample(const Ray& ray, const TilePixels& asked, Pixel& pixel, RayCounts& counts) const {
  if (tracer_ == Tracer::reference) {
    const reference::QuadTracer tracer(scene_.view(), ray.origin, ray.direction);
    pixel.color += rounded(tracer.radiance(pixel.signature, counts));
    return;
  }
  pixel.color +=
      region_ ? traced(ray, *region_, asked, pixel, counts) : traced(ray, region_of(ray), asked, pixel, counts);
}

Rgb TileRenderer::traced(const Ray& ray, const Region& region, const TilePixels& asked, Pixel& pixel,
                         RayCounts& counts) const {
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
