// SPDX-License-Identifier: BSD-3-Clause
#include "app/tile_list.h"

#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>

#include "io/error.h"

namespace tessera::app {
namespace {

struct WireTile {
  render::Rect rect;
  float cost;
};
static_assert(std::is_trivially_copyable_v<WireTile> && sizeof(WireTile) == 20);

[[noreturn]] void refuse(const std::string& why) {
  throw io::Error(io::ErrorKind::bad_scene, "the tiles from rank 0 are damaged (" + why + ")");
}

bool lies_in(const render::Rect& tile, const render::Rect& area) noexcept {
  const auto fits = [](std::uint64_t begin, std::uint64_t length, std::uint64_t from, std::uint64_t size) {
    return begin >= from && length > 0 && begin + length <= from + size;
  };
  return fits(tile.x, tile.width, area.x, area.width) && fits(tile.y, tile.height, area.y, area.height);
}

/// As many pixels as the area has, and none twice.
void require_cover(std::span<const render::CostedTile> tiles, const render::Rect& area) {
  std::size_t pixels = 0;
  for (const render::CostedTile& tile : tiles) pixels += tile.rect.pixels();
  if (pixels != area.pixels()) refuse("they do not fill the picture");
  std::vector<bool> covered(area.pixels());
  for (const render::CostedTile& tile : tiles) {
    for (std::size_t y = tile.rect.y - area.y; y != tile.rect.y - area.y + tile.rect.height; ++y) {
      for (std::size_t x = tile.rect.x - area.x; x != tile.rect.x - area.x + tile.rect.width; ++x) {
        if (covered[y * area.width + x]) refuse("they overlap");
        covered[y * area.width + x] = true;
      }
    }
  }
}

}  // namespace

scheduler::Bytes encode_tiles(std::span<const render::CostedTile> tiles) {
  scheduler::Bytes bytes(tiles.size() * sizeof(WireTile));
  std::byte* to = bytes.data();
  for (const render::CostedTile& tile : tiles) {
    const WireTile wire{tile.rect, static_cast<float>(tile.cost)};
    std::memcpy(to, &wire, sizeof wire);
    to += sizeof wire;
  }
  return bytes;
}

std::size_t encoded_size(std::uint32_t tiles) noexcept {
  return tiles * sizeof(WireTile);
}

std::vector<render::CostedTile> decode_tiles(std::span<const std::byte> bytes, const render::Rect& area) {
  if (bytes.size() % sizeof(WireTile) != 0) refuse("they are cut off");
  std::vector<render::CostedTile> tiles;
  tiles.reserve(bytes.size() / sizeof(WireTile));
  for (; !bytes.empty(); bytes = bytes.subspan(sizeof(WireTile))) {
    WireTile wire;
    std::memcpy(&wire, bytes.data(), sizeof wire);
    if (!lies_in(wire.rect, area)) refuse("one lies outside of the picture");
    if (!std::isfinite(wire.cost) || wire.cost < 0) refuse("one has no cost");
    tiles.push_back({wire.rect, wire.cost});
  }
  require_cover(tiles, area);
  return tiles;
}

}  // namespace tessera::app
