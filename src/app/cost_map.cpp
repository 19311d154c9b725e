// SPDX-License-Identifier: BSD-3-Clause
#include "app/cost_map.h"

#include <algorithm>
#include <cmath>

#include "io/place.h"

namespace tessera::app {
namespace {

/// Costs are kept for blocks of 8x8 pixels.
constexpr std::uint32_t kBlock = 8;

std::size_t blocks_along(std::uint32_t pixels) noexcept {
  return (std::size_t{pixels} + kBlock - 1) / kBlock;
}

/// Whether scaling one gives the other, up to a pixel of the smaller one.
bool have_one_shape(const render::Rect& a, const render::Rect& b) noexcept {
  const double scale = static_cast<double>(b.width) / a.width;
  return std::abs(a.height * scale - b.height) <= std::max(1.0, scale);
}

std::string size_text(const render::Rect& rect) {
  return std::to_string(rect.width) + "x" + std::to_string(rect.height);
}

}  // namespace

CostMap::CostMap(const std::vector<io::TileTime>& tiles, const render::Rect& area, const render::Rect& picture,
                 const std::string& file)
    : area_(area),
      columns_(blocks_along(area.width)),
      rows_(blocks_along(area.height)),
      sums_((columns_ + 1) * (rows_ + 1)) {
  const render::Rect bounds = bounds_of(tiles);
  const bool is_whole = bounds.x == 0 && bounds.y == 0 && have_one_shape(bounds, picture);
  if (!is_whole && !have_one_shape(bounds, area)) {
    io::refuse({file, 1, 1}, "the tiles make a picture of " + size_text(bounds) + " (this one is " + size_text(area) +
                                 ") use the file of a run with the same aspect");
  }
  const render::Rect& to = is_whole ? picture : area;
  const double scale_x = static_cast<double>(to.width) / bounds.width;
  const double scale_y = static_cast<double>(to.height) / bounds.height;
  for (const io::TileTime& tile : tiles) {
    const double left = to.x + (tile.rect.x - bounds.x) * scale_x;
    const double top = to.y + (tile.rect.y - bounds.y) * scale_y;
    spread({left, top, left + tile.rect.width * scale_x, top + tile.rect.height * scale_y},
           tile.seconds / static_cast<double>(tile.rect.pixels()));
  }
  add_up();
}

void CostMap::spread(const Box& box, double density) {
  const auto within = [](double place, std::uint32_t begin, std::uint32_t length) {
    return std::clamp(place - begin, 0.0, static_cast<double>(length));
  };
  const double left = within(box.left, area_.x, area_.width), right = within(box.right, area_.x, area_.width);
  const double top = within(box.top, area_.y, area_.height), bottom = within(box.bottom, area_.y, area_.height);
  const auto overlap = [](double begin, double end, std::size_t block) {
    const double from = static_cast<double>(block) * kBlock;
    return std::max(0.0, std::min(end, from + kBlock) - std::max(begin, from));
  };
  const auto end_row = static_cast<std::size_t>(std::ceil(bottom / kBlock));
  const auto end_column = static_cast<std::size_t>(std::ceil(right / kBlock));
  for (auto row = static_cast<std::size_t>(top / kBlock); row < end_row; ++row) {
    const double height = overlap(top, bottom, row);
    for (auto column = static_cast<std::size_t>(left / kBlock); column < end_column; ++column) {
      sums_[(row + 1) * (columns_ + 1) + column + 1] += density * height * overlap(left, right, column);
    }
  }
}

void CostMap::add_up() noexcept {
  for (std::size_t row = 1; row <= rows_; ++row) {
    double so_far = 0;
    for (std::size_t column = 1; column <= columns_; ++column) {
      double& here = sums_[row * (columns_ + 1) + column];
      so_far += here;
      here = so_far + corner(column, row - 1);
    }
  }
}

double CostMap::sum(double x, double y) const noexcept {
  // Between corners, interpolate; the last block ends with the area.
  const auto split = [](double place, std::size_t blocks, std::uint32_t length, std::size_t& block) {
    block = std::min(static_cast<std::size_t>(place / kBlock), blocks - 1);
    const double begin = static_cast<double>(block) * kBlock;
    return (place - begin) / (std::min(begin + kBlock, static_cast<double>(length)) - begin);
  };
  std::size_t column = 0, row = 0;
  const double right = split(x, columns_, area_.width, column);
  const double below = split(y, rows_, area_.height, row);
  const double above = std::lerp(corner(column, row), corner(column + 1, row), right);
  return std::lerp(above, std::lerp(corner(column, row + 1), corner(column + 1, row + 1), right), below);
}

double CostMap::seconds(const render::Rect& rect) const noexcept {
  const double left = rect.x - area_.x, top = rect.y - area_.y;
  const double right = left + rect.width, bottom = top + rect.height;
  return std::max(0.0, (sum(right, bottom) - sum(left, bottom)) - (sum(right, top) - sum(left, top)));
}

}  // namespace tessera::app
