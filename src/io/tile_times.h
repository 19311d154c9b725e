// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "render/image.h"

// What the tiles of an earlier run took, from the file that it wrote for --tile-stats.
namespace tessera::io {

/// units:   seconds
struct TileTime {
  render::Rect rect;
  double seconds = 0;
};

/// Reads tile statistics: a header line that names the columns, of which x, y, width, height, start_s and end_s are
/// used, and a line for each tile, in any order. There is at least one, and together they fill a rectangle.
/// throws:  Error(bad_scene / input_missing / io_failure)
std::vector<TileTime> read_tile_times(const std::filesystem::path& path);

/// The same from the text of a file; `file` is its name for messages.
std::vector<TileTime> parse_tile_times(std::string_view text, const std::string& file);

/// The smallest rectangle that holds all tiles.
/// requires: there is a tile
render::Rect bounds_of(const std::vector<TileTime>& tiles);

}  // namespace tessera::io
