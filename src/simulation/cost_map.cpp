// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/cost_map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tessera::simulation {
namespace {

// Tiles are seldom smaller. Within a block, costs count as even.
constexpr std::uint32_t kBlock = 8;

std::uint32_t blocks(std::uint32_t pixels) noexcept {
  return pixels / kBlock + (pixels % kBlock != 0);
}

std::uint32_t right_of(std::span<const io::TileRow> tiles) noexcept {
  std::uint32_t right = 0;
  for (const io::TileRow& tile : tiles) right = std::max(right, tile.x + tile.width);
  return right;
}

std::uint32_t bottom_of(std::span<const io::TileRow> tiles) noexcept {
  std::uint32_t bottom = 0;
  for (const io::TileRow& tile : tiles) bottom = std::max(bottom, tile.y + tile.height);
  return bottom;
}

/// How much of [begin, end) lies in block `i`.
double overlap(std::uint32_t begin, std::uint32_t end, std::uint32_t i) noexcept {
  return std::min(end, (i + 1) * kBlock) - std::max(begin, i * kBlock);
}

/// The block that a coordinate lies in, and how much of the block is before it, 0 ... 1. The last block may be
/// narrower.
struct Position {
  std::size_t block;
  double part;
};

Position position(double x, std::uint32_t pixels) noexcept {
  const std::uint32_t block = std::min(static_cast<std::uint32_t>(x) / kBlock, blocks(pixels) - 1);
  const std::uint32_t size = std::min(kBlock, pixels - block * kBlock);
  return {block, std::min(1.0, (x - block * kBlock) / size)};
}

}  // namespace

CostMap::Sums::Sums(std::uint32_t width, std::uint32_t height)
    : width_(width),
      height_(height),
      columns_(blocks(width)),
      rows_(blocks(height)),
      sums_((columns_ + 1) * (rows_ + 1)) {}

void CostMap::Sums::add(const render::Rect& tile, double amount) {
  const double per_pixel = amount / static_cast<double>(tile.pixels());
  for (std::uint32_t row = tile.y / kBlock; row < blocks(tile.y + tile.height); ++row) {
    const double height = overlap(tile.y, tile.y + tile.height, row);
    for (std::uint32_t column = tile.x / kBlock; column < blocks(tile.x + tile.width); ++column) {
      at(column + 1, row + 1) += per_pixel * height * overlap(tile.x, tile.x + tile.width, column);
    }
  }
}

void CostMap::Sums::sum_up() {
  for (std::size_t row = 1; row <= rows_; ++row) {
    for (std::size_t column = 1; column <= columns_; ++column) {
      at(column, row) += at(column - 1, row) + at(column, row - 1) - at(column - 1, row - 1);
    }
  }
}

double CostMap::Sums::to(double x, double y) const {
  const Position across = position(x, width_);
  const Position down = position(y, height_);
  return std::lerp(std::lerp(at(across.block, down.block), at(across.block + 1, down.block), across.part),
                   std::lerp(at(across.block, down.block + 1), at(across.block + 1, down.block + 1), across.part),
                   down.part);
}

double CostMap::Sums::within(double left, double top, double right, double bottom) const {
  return std::max(0.0, to(right, bottom) - to(left, bottom) - to(right, top) + to(left, top));
}

CostMap::CostMap(std::span<const io::TileRow> tiles)
    : width_(right_of(tiles)), height_(bottom_of(tiles)), seconds_(width_, height_), bytes_(width_, height_) {
  std::size_t pixels = 0;
  for (const io::TileRow& row : tiles) {
    const render::Rect tile{row.x, row.y, row.width, row.height};
    seconds_.add(tile, row.end_s - row.start_s);
    bytes_.add(tile, static_cast<double>(row.bytes));
    pixels += tile.pixels();
  }
  if (pixels == 0 || pixels != std::size_t{width_} * height_) {
    throw std::invalid_argument("the recorded tiles do not make a whole picture (" + std::to_string(pixels) +
                                " pixels for " + std::to_string(width_) + "x" + std::to_string(height_) +
                                ") record one without --crop");
  }
  seconds_.sum_up();
  bytes_.sum_up();
}

CostMap::Cost CostMap::of(const render::Rect& tile, const render::Rect& picture) const {
  const double across = static_cast<double>(width_) / picture.width;
  const double down = static_cast<double>(height_) / picture.height;
  const double left = tile.x * across;
  const double right = (tile.x + tile.width) * across;
  const double top = tile.y * down;
  const double bottom = (tile.y + tile.height) * down;
  const double per_recorded_pixel = 1 / (across * down);
  return {seconds_.within(left, top, right, bottom) * per_recorded_pixel,
          static_cast<std::size_t>(std::llround(bytes_.within(left, top, right, bottom) * per_recorded_pixel))};
}

}  // namespace tessera::simulation
