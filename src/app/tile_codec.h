// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/image.h"
#include "render/ray_counts.h"
#include "render/tile_renderer.h"
#include "scheduler/bytes.h"

// How a tile travels from the rank that renders it to rank 0.
//
//   1 byte              how its colours travel, and which ray counts are not 0
//   1 ... 10 bytes each shadow rays, mirror rays; those that are not 0, seven bits a byte, the lowest first
//   colours             one pixel where all are alike, or all of them; or a length like a ray count and an LZ4 block
//   signatures, errors  where the job asks for them
namespace tessera::app {

/// What the tiles bring home besides colours.
struct Layers {
  bool signatures = false;
  bool errors = false;
};

/// Whether colours are packed where that makes them shorter. Half a picture of spheres loses a third of its bytes, 0.7
/// a pixel; that costs the rank that renders 3 ns a pixel and rank 0 half a nanosecond (bench_codec), which is more
/// than the bytes cost in memory, and less than they do on Ethernet.
enum class Packing : std::uint8_t { never, where_shorter };

/// A tile as it arrived; its primary rays are known to everybody.
/// shapes:  each layer holds the tile's pixels, top row first; empty where the job does not ask for it
struct DeliveredTile {
  std::uint64_t shadow_rays = 0;
  std::uint64_t mirror_rays = 0;
  bool has_one_color = false;
  std::span<const std::byte> colors;  ///< a single pixel where has_one_color
  std::span<const std::byte> signatures;
  std::span<const std::byte> errors;
};

class TileCodec {
 public:
  TileCodec(render::PixelFormat format, Layers layers, Packing packing = Packing::never);

  /// shapes:  pixels as the layers ask for, one or more
  scheduler::Bytes encode(const render::RayCounts& rays, const render::TilePixels& pixels) const;

  /// What `delivered` says of a tile of so many pixels, until the next call, as views of `delivered` and of this.
  /// throws:  std::runtime_error that says what is wrong with the bytes
  DeliveredTile decode(std::span<const std::byte> delivered, std::size_t pixels);

 private:
  render::PixelFormat format_;
  Layers layers_;
  Packing packing_;
  std::vector<std::byte> unpacked_;
};

}  // namespace tessera::app
