// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "render/scene.h"
#include "render/signature_image.h"
#include "render/tile_renderer.h"
#include "scheduler/plan.h"
#include "scheduler/work.h"

// Where the renderer and the scheduler meet: tiles become tasks, and what a task delivers becomes part of a picture.
namespace tessera::app {

/// What the tiles bring home besides colours.
struct Layers {
  bool signatures = false;
  bool errors = false;
};

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
  scheduler::Policy policy = scheduler::Policy::dynamic;
  scheduler::MasterRole master = scheduler::MasterRole::automatic;
  std::optional<unsigned> prefetch;
  bool ask_back = true;
  double lease_s = 1;
};

scheduler::Bytes encode_job(const RenderJob& job);
/// throws:  io::Error where the bytes are no job
RenderJob decode_job(std::span<const std::byte> bytes);

/// The tiles of a job on `ranks` ranks: P bands for static-bands, rows for cyclic-rows, else a grid of the tile size.
std::vector<render::Rect> tiles_of(const RenderJob& job, std::uint32_t ranks);

/// How the job's tiles are to be shared out.
scheduler::Plan plan_of(const RenderJob& job, std::span<const render::Rect> tiles);

/// A rank's share of a job: renders any of its tiles. What it delivers for a tile is its ray counts, then its
/// pixels, layer by layer.
class TileWork {
 public:
  TileWork(const render::Scene& scene, const RenderJob& job, std::span<const render::Rect> tiles);

  scheduler::Bytes operator()(scheduler::TaskId task, const std::function<void()>& between_slices) const;

 private:
  render::TileRenderer renderer_;
  render::PixelFormat format_;
  Layers layers_;
  std::span<const render::Rect> tiles_;
};

/// Rank 0's picture, put together from what the tiles deliver in any order.
class Mosaic {
 public:
  Mosaic(const RenderJob& job, std::span<const render::Rect> tiles);

  /// throws:  std::runtime_error where the bytes do not fit the tile
  void accept(scheduler::TaskId task, std::span<const std::byte> delivered);

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
  /// Copies a tile's rows of one layer to their place, and returns where the next layer begins.
  const std::byte* place(const render::Rect& tile, std::size_t pixel_size, const std::byte* from, std::byte* to) const;

  render::Image image_;
  render::SignatureImage signatures_;
  std::vector<float> errors_;
  Layers layers_;
  render::Rect area_;
  std::uint64_t samples_;
  std::span<const render::Rect> tiles_;
  std::vector<std::uint32_t> missing_;  ///< pixels of each row
  std::uint32_t complete_rows_ = 0;
  std::vector<render::RayCounts> rays_;
};

}  // namespace tessera::app
