// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/tile_codec.h"
#include "render/scene.h"
#include "render/signature_image.h"
#include "render/tile.h"
#include "render/tile_renderer.h"
#include "scheduler/plan.h"
#include "scheduler/work.h"

// Where the renderer and the scheduler meet: tiles become tasks, and what a task delivers becomes part of a picture.
namespace tessera::app {

/// All that a rank must know to render; rank 0 reads it and sends it to the others.
struct RenderJob {
  render::SceneData scene;  ///< with a camera
  render::Rect area;        ///< the part of the picture to render
  render::PixelFormat format = render::PixelFormat::rgb8;
  render::Kernel kernel = render::Kernel::automatic;
  render::Tracer tracer = render::Tracer::fast;
  Layers layers;
  std::uint32_t tile_width = 16;
  std::uint32_t tile_height = 16;
  std::vector<render::CostedTile> cut;  ///< where it is not empty, the tiles, instead of those of the size; in seconds
  scheduler::Policy policy = scheduler::Policy::dynamic;
  scheduler::MasterRole master = scheduler::MasterRole::automatic;
  std::optional<unsigned> prefetch;
  bool ask_back = true;
  double lease_s = 1;
  bool compares_clocks = false;  ///< so that a trace can lay the ranks' times side by side
};

scheduler::Bytes encode_job(const RenderJob& job);
/// throws:  io::Error where the bytes are no job
RenderJob decode_job(std::span<const std::byte> bytes);

/// The tiles of a job on `ranks` ranks: P bands for static-bands, rows for cyclic-rows, else what it says itself or a
/// grid of the tile size.
std::vector<render::Rect> tiles_of(const RenderJob& job, std::uint32_t ranks);

/// Bytes that a mosaic keeps for a pixel, all layers together.
std::uint32_t stored_bytes_per_pixel(const RenderJob& job) noexcept;

/// How the job's tiles are to be shared out.
scheduler::Plan plan_of(const RenderJob& job, std::span<const render::Rect> tiles);

/// A rank's share of a job: renders any of its tiles.
class TileWork {
 public:
  /// `packing` changes how a tile travels, not what arrives.
  TileWork(const render::Scene& scene, const RenderJob& job, std::span<const render::Rect> tiles,
           Packing packing = Packing::never);

  scheduler::Bytes operator()(scheduler::TaskId task, const std::function<void()>& between_slices) const;

 private:
  render::TileRenderer renderer_;
  TileCodec codec_;
  render::PixelFormat format_;
  Layers layers_;
  std::span<const render::Rect> tiles_;
};

/// Rank 0's picture, put together from what the tiles deliver in any order. What no tile covers is to be restored
/// before the first of them.
class Mosaic {
 public:
  Mosaic(const RenderJob& job, std::span<const render::Rect> tiles);

  /// throws:  std::runtime_error with the tile's number where the bytes are no such tile
  void accept(scheduler::TaskId task, std::span<const std::byte> delivered);

  /// Copies what is in a rectangle of the area, layer by layer, row by row; puts it back.
  /// shapes:  stored_bytes_per_pixel for each of the rectangle's pixels
  void copy(const render::Rect& tile, std::span<std::byte> pixels) const;
  void restore(const render::Rect& tile, std::span<const std::byte> pixels);

  const render::Image& image() const noexcept { return image_; }
  /// Rows at the top of the picture that are there to their last pixel.
  std::uint32_t complete_rows() const noexcept { return complete_rows_; }
  /// Without pixels where the job does not ask for them.
  const render::SignatureImage& signatures() const noexcept { return signatures_; }
  /// The error bound of each pixel, row by row from the top; empty where the job does not ask for it.
  std::span<const float> errors() const noexcept { return errors_; }
  /// Rays of each tile.
  std::span<const render::RayCounts> rays() const noexcept { return rays_; }

 private:
  void count_complete_rows() noexcept;
  /// Copies a tile's rows of one layer to their place.
  void place(const render::Rect& tile, std::span<const std::byte> layer, std::span<std::byte> to) const;
  /// The other way round, and returns where the next layer begins.
  std::byte* copy_layer(const render::Rect& tile, std::size_t pixel_size, const std::byte* from, std::byte* to) const;
  /// Gives all of a tile's pixels this colour.
  void fill(const render::Rect& tile, std::span<const std::byte> color);
  /// Where the first pixel of a tile's row is among those of the picture.
  std::size_t row_start(const render::Rect& tile, std::uint32_t row) const noexcept {
    return std::size_t{tile.y - area_.y + row} * area_.width + (tile.x - area_.x);
  }

  render::Image image_;
  render::SignatureImage signatures_;
  std::vector<float> errors_;
  TileCodec codec_;
  render::Rect area_;
  std::uint64_t samples_;
  std::span<const render::Rect> tiles_;
  std::vector<std::uint32_t> missing_;  ///< pixels of each row
  std::uint32_t complete_rows_ = 0;
  std::vector<render::RayCounts> rays_;
};

}  // namespace tessera::app
