// SPDX-License-Identifier: BSD-3-Clause
#include "app/coverage.h"

#include <algorithm>

namespace tessera::app {

void Coverage::add(const render::Rect& tile) {
  for (std::size_t y = tile.y; y != std::size_t{tile.y} + tile.height; ++y) {
    const auto row = covered_.begin() + index_of(tile.x, y);
    std::fill(row, row + tile.width, true);
  }
}

bool Coverage::covers(const render::Rect& tile) const {
  for (std::size_t y = tile.y; y != std::size_t{tile.y} + tile.height; ++y) {
    const auto row = covered_.begin() + index_of(tile.x, y);
    if (std::find(row, row + tile.width, false) != row + tile.width) return false;
  }
  return true;
}

}  // namespace tessera::app
