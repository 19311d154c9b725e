// SPDX-License-Identifier: BSD-3-Clause
#include "render/tile.h"

#include <algorithm>
#include <bit>
#include <queue>

namespace tessera::render {
namespace {

/// A tile that may be halved.
struct Piece {
  CostedTile tile;
  std::uint32_t width = 0;  ///< before it was clipped to the area, as height
  std::uint32_t height = 0;

  /// The dearest is the largest; among equals, the first in reading order.
  friend bool operator<(const Piece& a, const Piece& b) noexcept {
    if (a.tile.cost != b.tile.cost) return a.tile.cost < b.tile.cost;
    if (a.tile.rect.y != b.tile.rect.y) return a.tile.rect.y > b.tile.rect.y;
    return a.tile.rect.x > b.tile.rect.x;
  }
};

}  // namespace

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

std::vector<CostedTile> cut_by_cost(const Rect& area, std::uint32_t longest,
                                    const std::function<double(const Rect&)>& cost_of,
                                    const std::function<double(double left)>& most_for) {
  std::priority_queue<Piece> pieces;
  const auto add_pieces = [&](const Rect& whole, std::uint32_t width, std::uint32_t height) {
    for (const Rect& rect : tile_grid(whole, width, height)) pieces.push({{rect, cost_of(rect)}, width, height});
  };
  const std::uint32_t side =
      std::bit_ceil(std::max(kShortestCutSide, std::min(longest, std::max(area.width, area.height))));
  add_pieces(area, side, side);

  double left = cost_of(area);
  std::vector<CostedTile> tiles;
  while (!pieces.empty()) {
    const Piece piece = pieces.top();
    pieces.pop();
    if (piece.tile.cost <= most_for(left) || std::max(piece.width, piece.height) == kShortestCutSide) {
      tiles.push_back(piece.tile);
      left = std::max(0.0, left - piece.tile.cost);
    } else if (piece.width > piece.height) {
      add_pieces(piece.tile.rect, piece.width / 2, piece.height);
    } else {
      add_pieces(piece.tile.rect, piece.width, piece.height / 2);
    }
  }
  return tiles;
}

}  // namespace tessera::render
