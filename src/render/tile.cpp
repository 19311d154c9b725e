// SPDX-License-Identifier: BSD-3-Clause
#include "render/tile.h"

#include <algorithm>

namespace tessera::render {

std::vector<Rect> tile_grid(const Rect& area, std::uint32_t tile_width, std::uint32_t tile_height) {
  const std::uint32_t w = std::clamp(tile_width, 1u, area.width);
  const std::uint32_t h = std::clamp(tile_height, 1u, area.height);
  std::vector<Rect> tiles;
  for (std::uint32_t y = 0; y < area.height; y += h) {
    for (std::uint32_t x = 0; x < area.width; x += w) {
      tiles.push_back({area.x + x, area.y + y, std::min(w, area.width - x), std::min(h, area.height - y)});
    }
  }
  return tiles;
}

std::vector<Rect> bands(const Rect& area, std::uint32_t count) {
  const std::uint64_t n = std::clamp(count, 1u, area.height);
  const auto edge = [&](std::uint64_t i) { return static_cast<std::uint32_t>(area.height * i / n); };
  std::vector<Rect> result;
  for (std::uint64_t i = 0; i != n; ++i) {
    result.push_back({area.x, area.y + edge(i), area.width, edge(i + 1) - edge(i)});
  }
  return result;
}

}  // namespace tessera::render
