// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/workload.h"

#include <cmath>
#include <random>
#include <stdexcept>

namespace tessera::simulation {

std::vector<io::TileRow> tiles_of(const EvenWork& work) {
  if (work.tiles == 0) throw std::invalid_argument("there must be tiles (there are none)");
  if (!(work.mean_s > 0) || !(work.spread >= 0 && work.spread <= 1)) {
    throw std::invalid_argument("tiles must take some time (mean > 0, spread 0 ... 1)");
  }
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(work.tiles)));
  const std::uint32_t rows = (work.tiles + columns - 1) / columns;
  std::mt19937_64 random(1);
  std::vector<io::TileRow> tiles;
  for (std::uint32_t i = 0; i != columns * rows; ++i) {
    const double u = static_cast<double>(random() >> 11) * 0x1p-53;  // 0 <= u < 1; the library's own differ
    io::TileRow tile;
    tile.tile = i;
    tile.x = i % columns * kEvenTileSize;
    tile.y = i / columns * kEvenTileSize;
    tile.width = kEvenTileSize;
    tile.height = kEvenTileSize;
    tile.end_s = work.mean_s * (1 + work.spread * (2 * u - 1));
    tile.bytes = work.bytes;
    tiles.push_back(tile);
  }
  return tiles;
}

}  // namespace tessera::simulation
