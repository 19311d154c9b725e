// SPDX-License-Identifier: BSD-3-Clause
#include "render/tile.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "render/random.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

/// Whether the tiles cover every pixel of the area once, and nothing else.
bool covers_once(const Rect& area, const std::vector<Rect>& tiles) {
  std::vector<int> count(area.pixels());
  for (const Rect& tile : tiles) {
    if (tile.width == 0 || tile.height == 0) return false;
    for (std::uint32_t y = tile.y; y != tile.y + tile.height; ++y) {
      for (std::uint32_t x = tile.x; x != tile.x + tile.width; ++x) {
        if (x < area.x || y < area.y || x - area.x >= area.width || y - area.y >= area.height) return false;
        ++count[std::size_t{y - area.y} * area.width + (x - area.x)];
      }
    }
  }
  return std::all_of(count.begin(), count.end(), [](int n) { return n == 1; });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tile)

// 5 x 3 in tiles of 2 x 2: three columns, two rows, from the area's corner; the rest at the right and the bottom.
BOOST_AUTO_TEST_CASE(grid_runs_row_by_row_from_the_top_left_corner) {
  const std::vector<Rect> expected{{10, 20, 2, 2}, {12, 20, 2, 2}, {14, 20, 1, 2},
                                   {10, 22, 2, 1}, {12, 22, 2, 1}, {14, 22, 1, 1}};
  BOOST_TEST((tile_grid({10, 20, 5, 3}, 2, 2) == expected));
}

BOOST_AUTO_TEST_CASE(tile_larger_than_the_area_is_the_area) {
  BOOST_TEST((tile_grid({3, 4, 5, 6}, 100, 100) == std::vector<Rect>{{3, 4, 5, 6}}));
  BOOST_TEST((tile_grid({3, 4, 5, 6}, 4294967295U, 4294967295U) == std::vector<Rect>{{3, 4, 5, 6}}));
}

BOOST_AUTO_TEST_CASE(grid_covers_every_pixel_once) {
  Random random(111);
  for (int i = 0; i != 500; ++i) {
    const Rect area{random.below(1000), random.below(1000), 1 + random.below(70), 1 + random.below(70)};
    const std::uint32_t w = 1 + random.below(80);
    const std::uint32_t h = 1 + random.below(80);
    const std::vector<Rect> tiles = tile_grid(area, w, h);
    BOOST_TEST(covers_once(area, tiles));
    BOOST_TEST(tiles.size() == std::size_t{(area.width + w - 1) / w} * ((area.height + h - 1) / h));
  }
}

// The largest picture's last tile ends at 65536, and nothing wraps.
BOOST_AUTO_TEST_CASE(grid_of_the_largest_picture_ends_at_its_corner) {
  const std::vector<Rect> tiles = tile_grid({0, 0, 65536, 65536}, 1000, 1000);
  BOOST_TEST(tiles.size() == 66U * 66U);
  BOOST_TEST((tiles.back() == Rect{65000, 65000, 536, 536}));
}

BOOST_AUTO_TEST_CASE(grid_next_to_the_end_of_the_numbers_does_not_wrap) {
  const std::uint32_t last = 4294967295U - 7;
  BOOST_TEST((tile_grid({last, last, 7, 7}, 5, 7) == std::vector<Rect>{{last, last, 5, 7}, {last + 5, last, 2, 7}}));
}

BOOST_AUTO_TEST_CASE(bands_are_whole_rows_that_differ_by_at_most_one) {
  Random random(112);
  for (int i = 0; i != 500; ++i) {
    const Rect area{random.below(1000), random.below(1000), 1 + random.below(20), 1 + random.below(200)};
    const std::uint32_t count = 1 + random.below(250);
    const std::vector<Rect> parts = bands(area, count);
    BOOST_TEST(covers_once(area, parts));
    BOOST_TEST(parts.size() == std::min(count, area.height));
    std::uint32_t next = area.y;
    std::uint32_t least = area.height;
    std::uint32_t most = 0;
    for (const Rect& band : parts) {
      BOOST_TEST((band.x == area.x && band.width == area.width && band.y == next));
      next += band.height;
      least = std::min(least, band.height);
      most = std::max(most, band.height);
    }
    BOOST_TEST(most - least <= 1U);
  }
}

BOOST_AUTO_TEST_CASE(a_cut_by_cost_covers_every_pixel_once) {
  for (const Rect& area : {Rect{0, 0, 64, 64}, Rect{3, 5, 77, 41}, Rect{9, 0, 1, 300}, Rect{0, 0, 5, 5}}) {
    for (const double most : {0.0, 1.0, 50.0, 1e9}) {
      const auto tiles = cut_by_cost(
          area, 128, [](const Rect& rect) { return double(rect.pixels()); }, [&](double) { return most; });
      std::vector<Rect> rects;
      for (const CostedTile& tile : tiles) rects.push_back(tile.rect);
      BOOST_TEST(covers_once(area, rects));
    }
  }
}

// All of the cost lies in the first 8x8 block. With half of what is left as the most: 64x64 costs 64 > 32, so do its
// left half ... down to that block, which cannot be halved.
BOOST_AUTO_TEST_CASE(only_what_is_dear_is_cut) {
  const auto cost_of = [](const Rect& rect) { return rect.x == 0 && rect.y == 0 ? 64.0 : 0.0; };
  const auto tiles = cut_by_cost({0, 0, 64, 64}, 64, cost_of, [](double left) { return left / 2; });
  BOOST_TEST_REQUIRE(tiles.size() == 7u);
  BOOST_TEST((tiles[0].rect == Rect{0, 0, 8, 8}));
  // What costs nothing follows in reading order.
  BOOST_TEST((tiles[1].rect == Rect{8, 0, 8, 8}));
  BOOST_TEST((tiles[2].rect == Rect{16, 0, 16, 16}));
  BOOST_TEST((tiles[6].rect == Rect{0, 32, 64, 32}));
}

BOOST_AUTO_TEST_CASE(no_tile_is_dearer_than_allowed_and_none_follows_a_cheaper_one) {
  const Rect area{0, 0, 200, 120};
  // A pixel costs more to the right.
  const auto cost_of = [](const Rect& rect) { return double(rect.pixels()) * (2 * rect.x + rect.width); };
  const auto tiles = cut_by_cost(area, 1024, cost_of, [](double left) { return std::max(left / 8, 5e4); });
  double left = cost_of(area);
  for (std::size_t i = 0; i != tiles.size(); ++i) {
    const Rect& rect = tiles[i].rect;
    BOOST_TEST(tiles[i].cost == cost_of(rect));
    if (i > 0) BOOST_TEST(tiles[i].cost <= tiles[i - 1].cost);
    BOOST_TEST(tiles[i].cost <= std::max(left / 8, 5e4));
    left -= tiles[i].cost;
  }
  BOOST_TEST(std::abs(left) < 1e-6);
  BOOST_TEST(tiles.front().rect.pixels() > 4 * tiles.back().rect.pixels());
}

BOOST_AUTO_TEST_CASE(a_cut_begins_with_squares_of_the_longest_side) {
  const auto tiles = cut_by_cost(
      {0, 0, 100, 30}, 20, [](const Rect&) { return 1.0; }, [](double) { return 1.0; });
  BOOST_TEST_REQUIRE(tiles.size() == 4u);
  BOOST_TEST((tiles[0].rect == Rect{0, 0, 32, 30}));
  BOOST_TEST((tiles[3].rect == Rect{96, 0, 4, 30}));
}

BOOST_AUTO_TEST_SUITE_END()
