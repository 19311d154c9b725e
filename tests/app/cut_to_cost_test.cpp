// SPDX-License-Identifier: BSD-3-Clause
#include "app/cut_to_cost.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "scheduler/grain.h"

using namespace tessera;
using namespace tessera::app;

namespace {

const render::Rect kArea{0, 0, 512, 512};

double even_seconds(const render::Rect& rect) {
  return 1e-6 * static_cast<double>(rect.pixels());
}

/// The same, but all of it comes from the upper half.
double upper_seconds(const render::Rect& rect) {
  return rect.y < 256 ? 2 * even_seconds(rect) : 0;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(cost_cut)

// W = 0.262 s. Two ranks: 1/16 of a share has 8192 pixels, so no side is longer than 64; the least is 100 us, and a
// tile of 16x8 takes 128.
BOOST_AUTO_TEST_CASE(tiles_shrink_from_a_sixteenth_of_a_share_to_what_is_worth_a_task) {
  const auto tiles = cut_to_cost(kArea, even_seconds, 2);
  BOOST_TEST(std::max(tiles.front().rect.width, tiles.front().rect.height) == 64u);
  double left_s = even_seconds(kArea);
  for (const render::CostedTile& tile : tiles) {
    BOOST_TEST(tile.cost <= scheduler::largest_task_s(left_s, even_seconds(kArea), 2) + 1e-12);
    left_s -= tile.cost;
  }
  BOOST_TEST(std::abs(left_s) < 1e-9);
  BOOST_TEST(tiles.back().cost < 100e-6);
  BOOST_TEST(tiles.back().cost > 25e-6);
}

BOOST_AUTO_TEST_CASE(what_is_predicted_to_cost_nothing_is_cut_all_the_same) {
  for (const render::CostedTile& tile : cut_to_cost(kArea, upper_seconds, 2)) {
    BOOST_TEST(tile.rect.width <= 64u);
    BOOST_TEST(tile.rect.height <= 64u);
  }
}

BOOST_AUTO_TEST_CASE(more_ranks_get_more_tiles_until_rank_0_could_not_keep_up) {
  const auto count = [](std::uint32_t ranks) { return cut_to_cost(kArea, even_seconds, ranks).size(); };
  BOOST_TEST(count(4) > count(2));
  BOOST_TEST(count(16) > count(4));
  // x = 5.3: a rank's share is some five times what rank 0 needs to serve all of them once.
  BOOST_TEST(count(128) < 128u * 5);
}

BOOST_AUTO_TEST_SUITE_END()
