// SPDX-License-Identifier: BSD-3-Clause
#include "io/tile_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "io/color_scale.h"
#include "io/png.h"
#include "io/rank_colors.h"

namespace tessera::io {
namespace {

const std::pair<std::string, std::string> kSoftware{"Software", "Tessera"};

std::string hex_of(const Rgb8& color) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", color[0], color[1], color[2]);
  return text;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void fill(render::Image& image, const render::Rect& place, const Rgb8& color) {
  for (std::uint32_t y = place.y; y != place.y + place.height; ++y) {
    std::byte* pixel = image.bytes.data() + 3 * (std::size_t{y} * image.width + place.x);
    for (std::uint32_t x = 0; x != place.width; ++x) {
      for (const std::uint8_t channel : color) *pixel++ = std::byte{channel};
    }
  }
}

/// Each tile in the colour that `color_of` gives for its index.
template <class ColorOf>
std::string encode(const render::Rect& area, std::span<const render::Rect> tiles, const PngText& text,
                   ColorOf&& color_of) {
  render::Image image(area.width, area.height, render::PixelFormat::rgb8);
  for (std::size_t i = 0; i != tiles.size(); ++i) {
    const render::Rect& tile = tiles[i];
    fill(image, {tile.x - area.x, tile.y - area.y, tile.width, tile.height}, color_of(i));
  }
  return encode_png(image, render::Transfer::srgb, text);
}

/// The smallest and largest of the values above 0, or twice 0 where there are none: a clock may be too coarse to see
/// the time that a tile took.
std::pair<double, double> range_of(std::span<const double> values) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const double value : values) {
    if (value > 0) least = std::min(least, value);
    most = std::max(most, value);
  }
  return {most > 0 ? least : 0.0, most};
}

}  // namespace

std::string encode_cost_map(const render::Rect& area, std::span<const render::Rect> tiles,
                            std::span<const double> seconds) {
  std::vector<double> costs(tiles.size());
  for (std::size_t i = 0; i != tiles.size(); ++i) costs[i] = seconds[i] / static_cast<double>(tiles[i].pixels());
  const auto [least, most] = range_of(costs);
  const double span = most > least ? std::log(most / least) : 1;
  const PngText text{kSoftware,
                     {"Title", "What each tile cost"},
                     {"Unit", "seconds per pixel"},
                     {"Scale", "logarithmic"},
                     {"Minimum", number(least)},
                     {"Maximum", number(most)},
                     {"Colors", "minimum " + hex_of(scale_color(0)) + ", maximum " + hex_of(scale_color(1)) +
                                    ", equal steps in Oklab between"}};
  return encode(area, tiles, text, [&, least = least](std::size_t i) {
    return scale_color(costs[i] > least ? std::log(costs[i] / least) / span : 0);
  });
}

std::string encode_owner_map(const render::Rect& area, std::span<const render::Rect> tiles,
                             std::span<const std::uint32_t> ranks, std::uint32_t rank_count) {
  const std::vector<Rgb8> colors = rank_colors(rank_count);
  std::string list;
  for (std::uint32_t rank = 0; rank != rank_count; ++rank) {
    if (rank > 0) list += '\n';
    list += std::to_string(rank);
    list += ' ';
    list += hex_of(colors[rank]);
  }
  const PngText text{kSoftware, {"Title", "Which rank rendered each tile"}, {"Colors", list}};
  return encode(area, tiles, text, [&](std::size_t i) { return colors[ranks[i]]; });
}

}  // namespace tessera::io
