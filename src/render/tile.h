// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "render/image.h"

// Ways to cut a picture into tiles. A tiling never changes the picture.
namespace tessera::render {

/// Cuts `area` into tiles of this size, row by row from its top left corner; tiles at the right and bottom edge are
/// what is left. A size larger than the area means one tile.
std::vector<Rect> tile_grid(const Rect& area, std::uint32_t tile_width, std::uint32_t tile_height);

/// Cuts `area` into `count` bands of whole rows whose heights differ by at most one; fewer where there are fewer rows.
std::vector<Rect> bands(const Rect& area, std::uint32_t count);

/// A tile and what it is predicted to cost.
struct CostedTile {
  Rect rect;
  double cost = 0;
};

/// Tiles that are cut by cost are no narrower or lower than this unless the area ends there.
inline constexpr std::uint32_t kShortestCutSide = 8;

/// Cuts `area` into squares of side `longest`, the next power of two, and halves those that are dear: no tile costs
/// more than `most_for` what is left of the cost, which is its own and that of all that are no dearer. The dearest
/// comes first, so tiles shrink towards the end. One that cannot be halved any more may cost more.
/// units:   costs: any, the same for all; cost_of and most_for give values that are finite and >= 0
std::vector<CostedTile> cut_by_cost(const Rect& area, std::uint32_t longest,
                                    const std::function<double(const Rect&)>& cost_of,
                                    const std::function<double(double left)>& most_for);

}  // namespace tessera::render
