// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/stats.h"

// The tile statistics of an earlier run, read back: what each part of the picture cost.
namespace tessera::io {

/// The rows of the text of a file; `file` is its name for messages.
/// throws:  Error(bad_scene) with the line where the text is no tile statistics
std::vector<TileRow> parse_tile_stats(std::string_view text, const std::string& file);

/// throws:  as parse_tile_stats, and Error(input_missing / io_failure)
std::vector<TileRow> read_tile_stats(const std::filesystem::path& path);

}  // namespace tessera::io
