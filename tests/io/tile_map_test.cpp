// SPDX-License-Identifier: BSD-3-Clause
#include "io/tile_map.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "io/color_scale.h"
#include "io/png.h"
#include "io/rank_colors.h"

namespace tessera::io {
namespace {

using render::Rect;

// Two tiles on top, one below, in a picture whose corner is elsewhere.
const Rect kArea{10, 20, 5, 3};
const std::vector<Rect> kTiles{{10, 20, 2, 2}, {12, 20, 3, 2}, {10, 22, 5, 1}};

Rgb8 pixel(const render::Image& image, std::uint32_t x, std::uint32_t y) {
  const std::byte* bytes = image.bytes.data() + 3 * (std::size_t{y} * image.width + x);
  return {std::to_integer<std::uint8_t>(bytes[0]), std::to_integer<std::uint8_t>(bytes[1]),
          std::to_integer<std::uint8_t>(bytes[2])};
}

void check_tiles(const std::string& png, const Rgb8& first, const Rgb8& second, const Rgb8& third) {
  const render::Image image = decode_png(png, "map");
  BOOST_REQUIRE_EQUAL(image.width, 5U);
  BOOST_REQUIRE_EQUAL(image.height, 3U);
  for (std::uint32_t y = 0; y != 3; ++y) {
    for (std::uint32_t x = 0; x != 5; ++x) {
      BOOST_TEST((pixel(image, x, y) == (y == 2 ? third : x < 2 ? first : second)), x << ", " << y);
    }
  }
}

bool says(const std::string& png, const std::string& keyword, const std::string& text) {
  return png.find(keyword + std::string(1, '\0') + text) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(TileMap)

BOOST_AUTO_TEST_CASE(costs_are_per_pixel_on_a_logarithmic_scale) {
  // 1, 10 and 100 microseconds a pixel
  const std::string png = encode_cost_map(kArea, kTiles, std::vector<double>{4e-6, 60e-6, 500e-6});
  check_tiles(png, scale_color(0), scale_color(0.5), scale_color(1));
  BOOST_TEST(says(png, "Unit", "seconds per pixel"));
  BOOST_TEST(says(png, "Scale", "logarithmic"));
  BOOST_TEST(says(png, "Minimum", "1e-06"));
  BOOST_TEST(says(png, "Maximum", "0.0001"));
}

BOOST_AUTO_TEST_CASE(equal_costs_are_equally_dark) {
  const std::string png = encode_cost_map(kArea, kTiles, std::vector<double>{4, 6, 5});
  check_tiles(png, scale_color(0), scale_color(0), scale_color(0));
}

BOOST_AUTO_TEST_CASE(a_cost_that_the_clock_did_not_see_counts_as_the_least_one) {
  const std::string png = encode_cost_map(kArea, kTiles, std::vector<double>{0, 6, 50});
  check_tiles(png, scale_color(0), scale_color(0), scale_color(1));
  BOOST_TEST(says(png, "Minimum", "1"));
  const std::string none = encode_cost_map(kArea, kTiles, std::vector<double>{0, 0, 0});
  check_tiles(none, scale_color(0), scale_color(0), scale_color(0));
  BOOST_TEST(says(none, "Maximum", "0"));
}

BOOST_AUTO_TEST_CASE(owners_have_their_colors_and_the_file_lists_them) {
  const std::string png = encode_owner_map(kArea, kTiles, std::vector<std::uint32_t>{2, 0, 1}, 4);
  const auto colors = rank_colors(4);
  check_tiles(png, colors[2], colors[0], colors[1]);
  BOOST_TEST(says(png, "Colors", "0 #4080df\n1 #bfff00\n2 #ff0000\n3 #404000"));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
