// SPDX-License-Identifier: BSD-3-Clause
#include "app/render_job.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "io/error.h"
#include "io/scene_codec.h"
#include "render/tile.h"

namespace tessera::app {
namespace {

/// The part of a job besides its scene, as it travels.
struct JobHeader {
  render::Rect area;
  std::uint32_t tile_width;
  std::uint32_t tile_height;
  std::uint32_t prefetch;  ///< 0: none given
  render::PixelFormat format;
  render::Kernel kernel;
  scheduler::Policy policy;
  scheduler::MasterRole master;
  render::Tracer tracer;
  Layers layers;
  bool ask_back;
  std::uint32_t unused;
  double lease_s;
};
static_assert(std::is_trivially_copyable_v<JobHeader> && sizeof(JobHeader) == 48);

/// In front of a tile's pixels; its primary rays are known to everybody.
struct TileHeader {
  std::uint64_t shadow_rays;
  std::uint64_t mirror_rays;
};
static_assert(std::is_trivially_copyable_v<TileHeader> && sizeof(TileHeader) == 16);

/// Bytes that a tile delivers.
std::size_t delivery_size(std::size_t pixels, render::PixelFormat format, Layers layers) {
  const std::size_t signature_size = layers.signatures ? sizeof(render::Signature) : 0;
  const std::size_t error_size = layers.errors ? sizeof(float) : 0;
  return sizeof(TileHeader) + pixels * (bytes_per_pixel(format) + signature_size + error_size);
}

}  // namespace

scheduler::Bytes encode_job(const RenderJob& job) {
  const JobHeader header{job.area,   job.tile_width, job.tile_height, job.prefetch.value_or(0),
                         job.format, job.kernel,     job.policy,      job.master,
                         job.tracer, job.layers,     job.ask_back,    {},
                         job.lease_s};
  const auto scene = io::encode_scene(job.scene);
  scheduler::Bytes bytes(sizeof header + scene.size());
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, scene.data(), scene.size());
  return bytes;
}

RenderJob decode_job(std::span<const std::byte> bytes) {
  JobHeader header;
  if (bytes.size() < sizeof header) throw io::Error(io::ErrorKind::bad_scene, "the job from rank 0 is cut off");
  std::memcpy(&header, bytes.data(), sizeof header);
  RenderJob job;
  job.scene = io::decode_scene(bytes.subspan(sizeof header));
  job.area = header.area;
  job.format = header.format;
  job.kernel = header.kernel;
  job.tracer = header.tracer;
  job.layers = header.layers;
  job.tile_width = header.tile_width;
  job.tile_height = header.tile_height;
  job.policy = header.policy;
  job.master = header.master;
  job.ask_back = header.ask_back;
  job.lease_s = header.lease_s;
  if (header.prefetch > 0) job.prefetch = header.prefetch;
  return job;
}

std::vector<render::Rect> tiles_of(const RenderJob& job, std::uint32_t ranks) {
  switch (job.policy) {
    case scheduler::Policy::static_bands:
      return render::bands(job.area, ranks);
    case scheduler::Policy::cyclic_rows:
      return render::tile_grid(job.area, job.area.width, 1);
    default:
      return render::tile_grid(job.area, job.tile_width, job.tile_height);
  }
}

scheduler::Plan plan_of(const RenderJob& job, std::span<const render::Rect> tiles) {
  return {job.policy, static_cast<std::uint32_t>(tiles.size()), {}, job.master, job.prefetch, job.ask_back,
          job.lease_s};
}

TileWork::TileWork(const render::Scene& scene, const RenderJob& job, std::span<const render::Rect> tiles)
    : renderer_(scene, job.format, job.tracer), format_(job.format), layers_(job.layers), tiles_(tiles) {}

scheduler::Bytes TileWork::operator()(scheduler::TaskId task, const std::function<void()>& between_slices) const {
  const render::Rect& tile = tiles_[index_of(task)];
  scheduler::Bytes delivered(delivery_size(tile.pixels(), format_, layers_));
  const auto colors = std::span(delivered).subspan(sizeof(TileHeader), tile.pixels() * bytes_per_pixel(format_));
  std::vector<render::Signature> signatures(layers_.signatures ? tile.pixels() : 0);
  std::vector<float> errors(layers_.errors ? tile.pixels() : 0);
  const auto counts = renderer_.render(tile, {colors, signatures, errors}, between_slices);
  const TileHeader header{counts.shadow, counts.mirror};
  std::memcpy(delivered.data(), &header, sizeof header);
  std::byte* layer = colors.data() + colors.size();
  for (const auto bytes : {std::as_bytes(std::span(signatures)), std::as_bytes(std::span(errors))}) {
    layer = std::copy(bytes.begin(), bytes.end(), layer);
  }
  return delivered;
}

Mosaic::Mosaic(const RenderJob& job, std::span<const render::Rect> tiles)
    : image_(job.area.width, job.area.height, job.format),
      signatures_{job.area.width, job.area.height,
                  std::vector<render::Signature>(job.layers.signatures ? job.area.pixels() : 0)},
      errors_(job.layers.errors ? job.area.pixels() : 0),
      layers_(job.layers),
      area_(job.area),
      samples_(job.scene.image.samples),
      tiles_(tiles),
      missing_(job.area.height, job.area.width),
      rays_(tiles.size()) {}

void Mosaic::accept(scheduler::TaskId task, std::span<const std::byte> delivered) {
  const render::Rect& tile = tiles_[index_of(task)];
  if (delivered.size() != delivery_size(tile.pixels(), image_.format, layers_)) {
    throw std::runtime_error("tile " + std::to_string(index_of(task)) + " arrived with " +
                             std::to_string(delivered.size()) + " bytes (its size asks for another number)");
  }
  TileHeader header;
  std::memcpy(&header, delivered.data(), sizeof header);
  rays_[index_of(task)] = {tile.pixels() * samples_, header.shadow_rays, header.mirror_rays};

  const std::byte* layer = delivered.data() + sizeof header;
  layer = place(tile, bytes_per_pixel(image_.format), layer, image_.bytes.data());
  if (layers_.signatures) {
    const auto to = std::as_writable_bytes(std::span(signatures_.pixels));
    layer = place(tile, sizeof(render::Signature), layer, to.data());
  }
  if (layers_.errors) place(tile, sizeof(float), layer, std::as_writable_bytes(std::span(errors_)).data());

  for (std::uint32_t y = tile.y - area_.y; y != tile.y - area_.y + tile.height; ++y) missing_[y] -= tile.width;
  while (complete_rows_ != area_.height && missing_[complete_rows_] == 0) ++complete_rows_;
}

const std::byte* Mosaic::place(const render::Rect& tile, std::size_t pixel_size, const std::byte* from,
                               std::byte* to) const {
  const std::size_t row_bytes = tile.width * pixel_size;
  for (std::uint32_t y = tile.y - area_.y; y != tile.y - area_.y + tile.height; ++y, from += row_bytes) {
    const std::size_t pixel = std::size_t{y} * area_.width + (tile.x - area_.x);
    std::memcpy(to + pixel * pixel_size, from, row_bytes);
  }
  return from;
}

}  // namespace tessera::app
