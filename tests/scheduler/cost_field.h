// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// Pictures that exist as costs alone, for schedules that need no renderer.
namespace tessera::scheduler::test {

/// Which parts of the picture are dear.
enum class Spread {
  flake,  ///< a cluster of mirrors: discs with smaller ones around them, the dearer the more of them overlap
  cloud,  ///< a round cloud in front of nothing, dearer towards its middle
  even,   ///< all the same
};

/// What each 8x8 block of a square picture costs, and thereby each rectangle.
class CostField {
 public:
  static constexpr std::uint32_t kBlockSide = 8;

  /// requires: side is a multiple of 8
  /// units:   seconds: a pixel takes pixel_s on the mean
  CostField(Spread spread, std::uint32_t side, double pixel_s)
      : blocks_(side / kBlockSide), sums_(std::size_t{blocks_ + 1} * (blocks_ + 1)) {
    double total = 0;
    std::vector<double> costs(std::size_t{blocks_} * blocks_);
    for (std::size_t i = 0; i != costs.size(); ++i) {
      const double u = (static_cast<double>(i % blocks_) + 0.5) / blocks_;
      const double v = (static_cast<double>(i / blocks_) + 0.5) / blocks_;
      total += costs[i] = relative_cost(spread, u, v);
    }
    const double scale = pixel_s * side * side / total;
    for (std::uint32_t y = 0; y != blocks_; ++y) {
      double row = 0;
      for (std::uint32_t x = 0; x != blocks_; ++x) {
        row += scale * costs[std::size_t{y} * blocks_ + x];
        sum(x + 1, y + 1) = sum(x + 1, y) + row;
      }
    }
  }

  std::uint32_t side() const { return blocks_ * kBlockSide; }

  /// What the pixels [x, x + width) x [y, y + height) take.
  double seconds(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) const {
    return std::fmax(0,
                     (before(x + width, y + height) - before(x, y + height)) - (before(x + width, y) - before(x, y)));
  }

  double seconds() const { return sum(blocks_, blocks_); }

 private:
  static double relative_cost(Spread spread, double u, double v) {
    const double sky = v < 0.3 ? 0.15 : 0.3;
    if (spread == Spread::even) return 1;
    if (spread == Spread::cloud) return 0.3 + 4 * std::fmax(0, 0.2 - ((u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5)));
    return sky + disc_cost(u, v, 0.55, 0.6, 0.17, 0);
  }

  static double disc_cost(double u, double v, double cx, double cy, double radius, int depth) {
    const double distance = std::hypot(u - cx, v - cy);
    if (distance > 2 * radius) return 0;
    double cost = distance < radius ? 1.0 : 0.0;
    if (depth == 4) return cost;
    for (int i = 0; i != 6; ++i) {
      const double angle = 1.0472 * i + 0.3 * depth;
      const double reach = radius * 4 / 3;
      cost += disc_cost(u, v, cx + reach * std::cos(angle), cy + reach * std::sin(angle), radius / 3, depth + 1);
    }
    return cost;
  }

  /// All that is left of x and above y; within a block all pixels cost the same.
  double before(std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t column = x / kBlockSide, row = y / kBlockSide;
    const std::uint32_t right = std::min(column + 1, blocks_), below = std::min(row + 1, blocks_);
    const double across = static_cast<double>(x % kBlockSide) / kBlockSide;
    const double down = static_cast<double>(y % kBlockSide) / kBlockSide;
    return std::lerp(std::lerp(sum(column, row), sum(right, row), across),
                     std::lerp(sum(column, below), sum(right, below), across), down);
  }

  double& sum(std::uint32_t x, std::uint32_t y) { return sums_[std::size_t{y} * (blocks_ + 1) + x]; }
  double sum(std::uint32_t x, std::uint32_t y) const { return sums_[std::size_t{y} * (blocks_ + 1) + x]; }

  std::uint32_t blocks_;
  std::vector<double> sums_;  ///< of all blocks left of and above a corner
};

}  // namespace tessera::scheduler::test
