// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "render/image.h"

// Ways to cut a picture into tiles. A tiling never changes the picture.
namespace tessera::render {

/// Cuts `area` into tiles of this size, row by row from its top left corner; tiles at the right and bottom edge are
/// what is left. A size larger than the area means one tile.
std::vector<Rect> tile_grid(const Rect& area, std::uint32_t tile_width, std::uint32_t tile_height);

/// Cuts `area` into `count` bands of whole rows whose heights differ by at most one; fewer where there are fewer rows.
std::vector<Rect> bands(const Rect& area, std::uint32_t count);

}  // namespace tessera::render
