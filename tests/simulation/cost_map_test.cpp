// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/cost_map.h"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "render/tile.h"

namespace tessera::simulation {
namespace {

namespace tt = boost::test_tools;

io::TileRow row(const render::Rect& tile, double seconds, std::uint64_t bytes) {
  io::TileRow row;
  row.x = tile.x;
  row.y = tile.y;
  row.width = tile.width;
  row.height = tile.height;
  row.start_s = 3;
  row.end_s = 3 + seconds;
  row.bytes = bytes;
  return row;
}

/// 40x20 pixels in tiles of 16x16 and what is left of them; tile i takes i + 1 seconds and 100 i bytes.
std::vector<io::TileRow> recorded() {
  std::vector<io::TileRow> rows;
  for (const render::Rect& tile : render::tile_grid({0, 0, 40, 20}, 16, 16)) {
    rows.push_back(row(tile, static_cast<double>(rows.size()) + 1, 100 * rows.size()));
  }
  return rows;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(cost_map)

BOOST_AUTO_TEST_CASE(a_recorded_tile_costs_what_it_cost) {
  const std::vector<io::TileRow> rows = recorded();
  const CostMap map(rows);
  BOOST_TEST(map.width() == 40U);
  BOOST_TEST(map.height() == 20U);
  for (const io::TileRow& tile : rows) {
    const CostMap::Cost cost = map.of({tile.x, tile.y, tile.width, tile.height}, {0, 0, 40, 20});
    BOOST_TEST(cost.seconds == tile.end_s - tile.start_s, tt::tolerance(1e-12));
    BOOST_TEST(cost.bytes == tile.bytes);
  }
}

BOOST_AUTO_TEST_CASE(any_tiling_costs_the_same_in_all) {
  const CostMap map(recorded());
  const render::Rect picture{0, 0, 40, 20};
  for (const auto& tiles : {render::tile_grid(picture, 7, 5), render::bands(picture, 3), std::vector{picture}}) {
    double seconds = 0;
    for (const render::Rect& tile : tiles) seconds += map.of(tile, picture).seconds;
    BOOST_TEST(seconds == 1 + 2 + 3 + 4 + 5 + 6, tt::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(half_a_tile_costs_half_of_it) {
  const CostMap map(recorded());
  BOOST_TEST(map.of({16, 0, 16, 8}, {0, 0, 40, 20}).seconds == 2.0 / 2, tt::tolerance(1e-12));
  BOOST_TEST(map.of({8, 0, 16, 16}, {0, 0, 40, 20}).seconds == 1.0 / 2 + 2.0 / 2, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_larger_picture_costs_as_much_more_as_it_has_pixels) {
  const CostMap map(recorded());
  const CostMap::Cost cost = map.of({32, 0, 32, 32}, {0, 0, 80, 40});
  BOOST_TEST(cost.seconds == 4 * 2.0, tt::tolerance(1e-12));
  BOOST_TEST(cost.bytes == 4U * 100);
  BOOST_TEST(map.of({96, 0, 24, 48}, {0, 0, 120, 60}).seconds == 9 * 3.0, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(tiles_that_make_no_whole_picture_are_refused) {
  std::vector<io::TileRow> rows = recorded();
  rows.pop_back();
  BOOST_CHECK_THROW(CostMap{rows}, std::invalid_argument);
  BOOST_CHECK_THROW(CostMap{std::vector<io::TileRow>()}, std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::simulation
