// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "render/image.h"

namespace tessera::app {

/// Which pixels of an area are there already.
class Coverage {
 public:
  explicit Coverage(const render::Rect& area) : area_(area), covered_(area.pixels()) {}

  /// requires: tile lies in the area, here and below
  void add(const render::Rect& tile);

  /// Whether all pixels of `tile` are there.
  bool covers(const render::Rect& tile) const;

 private:
  /// A pixel's place in the area, row by row.
  std::ptrdiff_t index_of(std::size_t x, std::size_t y) const noexcept {
    return static_cast<std::ptrdiff_t>((y - area_.y) * area_.width + (x - area_.x));
  }

  render::Rect area_;
  std::vector<bool> covered_;
};

}  // namespace tessera::app
