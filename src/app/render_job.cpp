// SPDX-License-Identifier: BSD-3-Clause
#include "app/render_job.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "app/tile_list.h"
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
  std::uint32_t cut;       ///< tiles that follow
  render::PixelFormat format;
  render::Kernel kernel;
  scheduler::Policy policy;
  scheduler::MasterRole master;
  render::Tracer tracer;
  Layers layers;
  bool ask_back;
  bool compares_clocks;
  std::array<std::byte, 7> unused;
  double lease_s;
};
static_assert(std::is_trivially_copyable_v<JobHeader> && sizeof(JobHeader) == 56);

}  // namespace

scheduler::Bytes encode_job(const RenderJob& job) {
  const JobHeader header{job.area,
                         job.tile_width,
                         job.tile_height,
                         job.prefetch.value_or(0),
                         static_cast<std::uint32_t>(job.cut.size()),
                         job.format,
                         job.kernel,
                         job.policy,
                         job.master,
                         job.tracer,
                         job.layers,
                         job.ask_back,
                         job.compares_clocks,
                         {},
                         job.lease_s};
  const auto scene = io::encode_scene(job.scene);
  const scheduler::Bytes tiles = encode_tiles(job.cut);
  scheduler::Bytes bytes(sizeof header + tiles.size() + scene.size());
  std::memcpy(bytes.data(), &header, sizeof header);
  std::copy(tiles.begin(), tiles.end(), bytes.begin() + sizeof header);
  std::copy(scene.begin(), scene.end(), bytes.end() - static_cast<std::ptrdiff_t>(scene.size()));
  return bytes;
}

RenderJob decode_job(std::span<const std::byte> bytes) {
  JobHeader header;
  if (bytes.size() < sizeof header) throw io::Error(io::ErrorKind::bad_scene, "the job from rank 0 is cut off");
  std::memcpy(&header, bytes.data(), sizeof header);
  bytes = bytes.subspan(sizeof header);
  if (bytes.size() < encoded_size(header.cut)) {
    throw io::Error(io::ErrorKind::bad_scene, "the tiles from rank 0 are cut off");
  }
  RenderJob job;
  job.area = header.area;
  if (header.cut > 0) job.cut = decode_tiles(bytes.first(encoded_size(header.cut)), job.area);
  job.scene = io::decode_scene(bytes.subspan(encoded_size(header.cut)));
  job.format = header.format;
  job.kernel = header.kernel;
  job.tracer = header.tracer;
  job.layers = header.layers;
  job.compares_clocks = header.compares_clocks;
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
      break;
  }
  if (job.cut.empty()) return render::tile_grid(job.area, job.tile_width, job.tile_height);
  std::vector<render::Rect> tiles;
  tiles.reserve(job.cut.size());
  for (const render::CostedTile& tile : job.cut) tiles.push_back(tile.rect);
  return tiles;
}

std::uint32_t stored_bytes_per_pixel(const RenderJob& job) noexcept {
  const std::size_t signature_size = job.layers.signatures ? sizeof(render::Signature) : 0;
  const std::size_t error_size = job.layers.errors ? sizeof(float) : 0;
  return static_cast<std::uint32_t>(bytes_per_pixel(job.format) + signature_size + error_size);
}

scheduler::Plan plan_of(const RenderJob& job, std::span<const render::Rect> tiles) {
  scheduler::Plan plan{job.policy, static_cast<std::uint32_t>(tiles.size()), {}, job.master, job.prefetch, job.ask_back,
                       job.lease_s};
  if (has_owners(job.policy)) return plan;
  // Of a job that is resumed, only some tiles are left, in the same order.
  plan.costs.reserve(job.cut.size());
  for (const render::CostedTile& tile : job.cut) {
    const std::size_t next = plan.costs.size();
    if (next != tiles.size() && tile.rect == tiles[next]) plan.costs.push_back(tile.cost);
  }
  return plan;
}

TileWork::TileWork(const render::Scene& scene, const RenderJob& job, std::span<const render::Rect> tiles,
                   Packing packing)
    : renderer_(scene, job.format, job.tracer),
      codec_(job.format, job.layers, packing),
      format_(job.format),
      layers_(job.layers),
      tiles_(tiles) {}

scheduler::Bytes TileWork::operator()(scheduler::TaskId task, const std::function<void()>& between_slices) const {
  const render::Rect& tile = tiles_[index_of(task)];
  std::vector<std::byte> colors(tile.pixels() * bytes_per_pixel(format_));
  std::vector<render::Signature> signatures(layers_.signatures ? tile.pixels() : 0);
  std::vector<float> errors(layers_.errors ? tile.pixels() : 0);
  const render::TilePixels pixels{colors, signatures, errors};
  const auto rays = renderer_.render(tile, pixels, between_slices);
  return codec_.encode(rays, pixels);
}

Mosaic::Mosaic(const RenderJob& job, std::span<const render::Rect> tiles)
    : image_(job.area.width, job.area.height, job.format),
      signatures_{job.area.width, job.area.height,
                  std::vector<render::Signature>(job.layers.signatures ? job.area.pixels() : 0)},
      errors_(job.layers.errors ? job.area.pixels() : 0),
      codec_(job.format, job.layers),
      area_(job.area),
      samples_(job.scene.image.samples),
      tiles_(tiles),
      missing_(job.area.height),
      rays_(tiles.size()) {
  for (const render::Rect& tile : tiles) {
    for (std::uint32_t y = tile.y - area_.y; y != tile.y - area_.y + tile.height; ++y) missing_[y] += tile.width;
  }
  count_complete_rows();
}

void Mosaic::accept(scheduler::TaskId task, std::span<const std::byte> delivered) {
  const render::Rect& tile = tiles_[index_of(task)];
  DeliveredTile arrived;
  try {
    arrived = codec_.decode(delivered, tile.pixels());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("tile " + std::to_string(index_of(task)) + " arrived damaged (" + error.what() + ")");
  }
  rays_[index_of(task)] = {tile.pixels() * samples_, arrived.shadow_rays, arrived.mirror_rays};
  if (arrived.has_one_color) {
    fill(tile, arrived.colors);
  } else {
    place(tile, arrived.colors, image_.bytes);
  }
  place(tile, arrived.signatures, std::as_writable_bytes(std::span(signatures_.pixels)));
  place(tile, arrived.errors, std::as_writable_bytes(std::span(errors_)));
  for (std::uint32_t y = tile.y - area_.y; y != tile.y - area_.y + tile.height; ++y) missing_[y] -= tile.width;
  count_complete_rows();
}

void Mosaic::count_complete_rows() noexcept {
  while (complete_rows_ != area_.height && missing_[complete_rows_] == 0) ++complete_rows_;
}

void Mosaic::restore(const render::Rect& tile, std::span<const std::byte> pixels) {
  const auto take_layer = [&](std::size_t pixel_size) {
    const auto layer = pixels.first(tile.pixels() * pixel_size);
    pixels = pixels.subspan(layer.size());
    return layer;
  };
  place(tile, take_layer(bytes_per_pixel(image_.format)), image_.bytes);
  if (!signatures_.pixels.empty()) {
    place(tile, take_layer(sizeof(render::Signature)), std::as_writable_bytes(std::span(signatures_.pixels)));
  }
  if (!errors_.empty()) place(tile, take_layer(sizeof(float)), std::as_writable_bytes(std::span(errors_)));
}

void Mosaic::copy(const render::Rect& tile, std::span<std::byte> pixels) const {
  std::byte* layer = copy_layer(tile, bytes_per_pixel(image_.format), image_.bytes.data(), pixels.data());
  if (!signatures_.pixels.empty()) {
    const auto from = std::as_bytes(std::span(signatures_.pixels));
    layer = copy_layer(tile, sizeof(render::Signature), from.data(), layer);
  }
  if (!errors_.empty()) copy_layer(tile, sizeof(float), std::as_bytes(std::span(errors_)).data(), layer);
}

std::byte* Mosaic::copy_layer(const render::Rect& tile, std::size_t pixel_size, const std::byte* from,
                              std::byte* to) const {
  const std::size_t row_bytes = tile.width * pixel_size;
  for (std::uint32_t y = tile.y - area_.y; y != tile.y - area_.y + tile.height; ++y, to += row_bytes) {
    const std::size_t pixel = std::size_t{y} * area_.width + (tile.x - area_.x);
    std::memcpy(to, from + pixel * pixel_size, row_bytes);
  }
  return to;
}

void Mosaic::place(const render::Rect& tile, std::span<const std::byte> layer, std::span<std::byte> to) const {
  if (layer.empty()) return;
  const std::size_t pixel_size = layer.size() / tile.pixels();
  const std::size_t row_bytes = tile.width * pixel_size;
  for (std::uint32_t row = 0; row != tile.height; ++row) {
    std::memcpy(to.data() + row_start(tile, row) * pixel_size, layer.data() + row * row_bytes, row_bytes);
  }
}

void Mosaic::fill(const render::Rect& tile, std::span<const std::byte> color) {
  const std::size_t row_bytes = tile.width * color.size();
  std::byte* const first_row = image_.bytes.data() + row_start(tile, 0) * color.size();
  std::memcpy(first_row, color.data(), color.size());
  for (std::size_t done = color.size(); done < row_bytes; done *= 2) {
    std::memcpy(first_row + done, first_row, std::min(done, row_bytes - done));
  }
  for (std::uint32_t row = 1; row != tile.height; ++row) {
    std::memcpy(image_.bytes.data() + row_start(tile, row) * color.size(), first_row, row_bytes);
  }
}

}  // namespace tessera::app
