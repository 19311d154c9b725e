// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/camera.h"
#include "render/image.h"
#include "render/raster.h"
#include "render/region.h"
#include "render/signature.h"
#include "render/tracer.h"

// The pixels of a tile. They depend on the scene, the image settings and their own place alone: not on the tile that
// they are rendered in, nor on who renders it.
namespace tessera::render {

/// Who follows the paths.
enum class Tracer : std::uint8_t {
  fast,       ///< tracer.h
  reference,  ///< reference/quad_tracer.h: quad precision and brute force, some ten thousand times slower
};

/// Where the pixels of a tile go, layer by layer, top row first.
/// shapes:  colors has room for the tile's pixels in the renderer's format; the others for one a pixel, or are empty
///          where they are not asked for
struct TilePixels {
  std::span<std::byte> colors;
  std::span<Signature> signatures{};
  std::span<float> errors{};  ///< bounds on the error of a linear channel, infinite where uncertified; see path_error.h
};

class Wavefront;

/// Renders a picture tile by tile. What it remembers of earlier tiles never changes a pixel.
class TileRenderer {
 public:
  /// requires: scene has a camera (see framed_camera) and outlives the renderer
  TileRenderer(const Scene& scene, PixelFormat format, Tracer tracer = Tracer::fast);

  /// Renders the pixels of `tile`, in coordinates of the whole picture, and calls `between_slices` every 0.1 ms or so.
  /// Not for two threads at once.
  /// requires: a reference is not asked for errors, for it knows no bound on its own
  RayCounts render(const Rect& tile, const TilePixels& out, const std::function<void()>& between_slices) const;

 private:
  struct Pixel {
    Rgb color;
    Signature signature;
    double error = 0;
  };
  /// Many paths at once, where nobody watches them.
  std::vector<Rgb> block_pixels(const Rect& block, Wavefront& wavefront, RayCounts& counts,
                                const std::function<void()>& between_slices) const;
  /// The same with first spheres that are drawn. `quiet_blocks` counts those since the last slice in which there is
  /// nothing to see.
  std::vector<Rgb> drawn_pixels(const Rect& block, avx2::Raster& raster, Wavefront& wavefront, RayCounts& counts,
                                const std::function<void()>& between_slices, std::uint32_t& quiet_blocks) const;
  bool can_draw() const noexcept;
  RayCounts render_one_by_one(const Rect& tile, const TilePixels& out,
                              const std::function<void()>& between_slices) const;
  Pixel pixel(std::uint32_t x, std::uint32_t y, const TilePixels& asked, RayCounts& counts) const;
  void add_sample(const Ray& ray, const TilePixels& asked, Pixel& pixel, RayCounts& counts) const;
  Rgb traced(const Ray& ray, const Region& region, const TilePixels& asked, Pixel& pixel, RayCounts& counts) const;

  /// Where on an axis of the picture a sample of its pixel i is.
  double sample_place(std::uint32_t i, std::uint32_t sample) const noexcept { return i + (sample + 0.5) / grid_; }
  /// shapes:  sample < samples per pixel, row by row on their grid
  Ray camera_ray(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const noexcept;
  Region region_of(const Ray& ray) const;
  Rgb mean_of_samples(const Rgb& sum) const noexcept;

  const Scene& scene_;
  PixelFormat format_;
  Tracer tracer_;
  CameraRays camera_;
  TraceOptions trace_options_;
  std::shared_ptr<Wavefront> wavefront_;  ///< learns where shadows fall from tile to tile; copies share it
  std::uint32_t grid_;                    ///< samples per pixel on each axis
  Placement eye_placement_;               ///< perspective only
  std::optional<Region> region_;          ///< perspective, where it is the same for every ray
  mutable DrawingRecord drawing_;
};

}  // namespace tessera::render
