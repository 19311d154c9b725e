// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "render/camera.h"
#include "render/image.h"
#include "render/region.h"
#include "render/tracer.h"

// The pixels of a tile. They depend on the scene, the image settings and their own place alone: not on the tile that
// they are rendered in, nor on who renders it.
namespace tessera::render {

class TileRenderer {
 public:
  /// requires: scene has a camera (see framed_camera) and outlives the renderer
  TileRenderer(const Scene& scene, PixelFormat format);

  /// Renders the pixels of `tile`, in coordinates of the whole picture, and calls `between_slices` every few hundred
  /// rays. shapes:  pixels has room for tile.pixels() of the format, top row first
  RayCounts render(const Rect& tile, std::span<std::byte> pixels, const std::function<void()>& between_slices) const;

 private:
  Rgb pixel(std::uint32_t x, std::uint32_t y, RayCounts& counts) const;
  Rgb sample(double x, double y, RayCounts& counts) const;

  const Scene& scene_;
  PixelFormat format_;
  CameraRays camera_;
  TraceOptions trace_options_;
  std::uint32_t grid_;            ///< samples per pixel on each axis
  Placement eye_placement_;       ///< perspective only
  std::optional<Region> region_;  ///< perspective, where it is the same for every ray
};

}  // namespace tessera::render
