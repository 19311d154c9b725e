// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "io/stats.h"

// Work that nobody has recorded, for questions about the scheduler alone.
namespace tessera::simulation {

/// Tiles of which each takes about as long as the others.
struct EvenWork {
  std::uint32_t tiles = 0;
  double mean_s = 0;
  double spread = 0;           ///< a tile takes mean_s (1 - spread) ... mean_s (1 + spread), evenly distributed
  std::uint32_t bytes = 3088;  ///< that each delivers
};

/// Side of the tiles.
inline constexpr std::uint32_t kEvenTileSize = 32;

/// The tiles as if they had been recorded: a grid as square as can be, with as many tiles or a few more. Equal work
/// gives equal tiles, on every platform.
/// throws:  std::invalid_argument where there are no tiles, or times below 0
std::vector<io::TileRow> tiles_of(const EvenWork& work);

}  // namespace tessera::simulation
