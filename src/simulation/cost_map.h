// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/stats.h"
#include "render/image.h"

namespace tessera::simulation {

/// What each part of a picture costs, for tiles of any shape and for a picture of any resolution: the costs of recorded
/// tiles, each spread evenly over its pixels. A larger picture of the same scene costs as much more as it has pixels.
class CostMap {
 public:
  /// throws:  std::invalid_argument where the tiles have not as many pixels as a picture that begins at (0, 0)
  explicit CostMap(std::span<const io::TileRow> tiles);

  std::uint32_t width() const noexcept { return width_; }
  std::uint32_t height() const noexcept { return height_; }

  /// What a tile takes and how many bytes it delivers.
  struct Cost {
    double seconds = 0;
    std::size_t bytes = 0;
  };

  /// The cost of a part of the picture at the resolution `picture`, which begins at (0, 0).
  Cost of(const render::Rect& tile, const render::Rect& picture) const;

 private:
  /// A quantity of the whole picture, summed from (0, 0) to each corner of a grid of blocks.
  class Sums {
   public:
    Sums(std::uint32_t width, std::uint32_t height);

    /// Spreads `amount` over a tile.
    void add(const render::Rect& tile, double amount);
    /// To be called once, after the last tile was added.
    void sum_up();
    /// The amount in a part of the picture; the coordinates are in recorded pixels.
    double within(double left, double top, double right, double bottom) const;

   private:
    double to(double x, double y) const;
    double& at(std::size_t column, std::size_t row) { return sums_[row * (columns_ + 1) + column]; }
    double at(std::size_t column, std::size_t row) const { return sums_[row * (columns_ + 1) + column]; }

    std::uint32_t width_;  ///< pixels
    std::uint32_t height_;
    std::size_t columns_;  ///< blocks
    std::size_t rows_;
    std::vector<double> sums_;
  };

  std::uint32_t width_;
  std::uint32_t height_;
  Sums seconds_;
  Sums bytes_;
};

}  // namespace tessera::simulation
