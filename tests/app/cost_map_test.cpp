// SPDX-License-Identifier: BSD-3-Clause
#include "app/cost_map.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "io/error.h"
#include "render/tile.h"

using namespace tessera;
using namespace tessera::app;

namespace {

const auto nearly = boost::test_tools::tolerance(1e-9);

/// Tiles whose pixels take as many seconds as what(x, y) of the tile's corner.
template <class What>
std::vector<io::TileTime> tiles_of(const render::Rect& area, std::uint32_t side, const What& what) {
  std::vector<io::TileTime> tiles;
  for (const render::Rect& rect : render::tile_grid(area, side, side)) {
    tiles.push_back({rect, what(rect.x, rect.y) * static_cast<double>(rect.pixels())});
  }
  return tiles;
}

double left_is_dear(std::uint32_t x, std::uint32_t) {
  return x < 32 ? 3 : 1;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(cost_map)

BOOST_AUTO_TEST_CASE(a_tile_of_theirs_costs_what_it_did_and_so_do_its_parts) {
  const render::Rect picture{0, 0, 64, 48};
  const CostMap costs(tiles_of(picture, 16, left_is_dear), picture, picture, "t.csv");
  BOOST_TEST(costs.seconds({16, 16, 16, 16}) == 3 * 256.0, nearly);
  BOOST_TEST(costs.seconds({24, 0, 16, 8}) == (3 + 1) * 64.0, nearly);
  BOOST_TEST(costs.seconds({33, 5, 7, 3}) == 21.0, nearly);
  BOOST_TEST(costs.seconds() == (3 + 1) * 32 * 48.0, nearly);
}

BOOST_AUTO_TEST_CASE(tiles_that_no_block_ends_with_are_shared_out_by_area) {
  const render::Rect picture{0, 0, 21, 13};
  const CostMap costs(tiles_of(picture, 5, [](auto, auto) { return 2.0; }), picture, picture, "t.csv");
  for (const render::Rect& rect : {render::Rect{0, 0, 21, 13}, {3, 2, 11, 7}, {20, 12, 1, 1}, {16, 8, 5, 5}}) {
    BOOST_TEST(costs.seconds(rect) == 2.0 * static_cast<double>(rect.pixels()), nearly);
  }
}

BOOST_AUTO_TEST_CASE(another_resolution_costs_as_much_a_pixel) {
  const auto small = tiles_of({0, 0, 64, 48}, 8, left_is_dear);
  const render::Rect picture{0, 0, 256, 192};
  const CostMap larger(small, picture, picture, "t.csv");
  BOOST_TEST(larger.seconds({0, 0, 128, 192}) == 3 * 128 * 192.0, nearly);
  BOOST_TEST(larger.seconds({128, 0, 128, 192}) == 128 * 192.0, nearly);
  const render::Rect half{0, 0, 32, 24};
  const CostMap smaller(small, half, half, "t.csv");
  BOOST_TEST(smaller.seconds() == (3 + 1) * 16 * 24.0, nearly);
}

BOOST_AUTO_TEST_CASE(a_part_of_the_picture_takes_its_share_of_the_whole_ones_costs) {
  const render::Rect crop{29, 3, 7, 11};
  const CostMap costs(tiles_of({0, 0, 64, 48}, 16, left_is_dear), crop, {0, 0, 64, 48}, "t.csv");
  BOOST_TEST(costs.seconds() == (3 * 3 + 1 * 4) * 11.0, nearly);
  BOOST_TEST(costs.seconds({32, 4, 2, 2}) == costs.seconds({33, 5, 2, 2}), nearly);
}

BOOST_AUTO_TEST_CASE(costs_of_the_same_part_are_taken_as_that) {
  const render::Rect crop{24, 8, 24, 16};
  const CostMap costs(tiles_of(crop, 8, left_is_dear), crop, {0, 0, 64, 64}, "t.csv");
  BOOST_TEST(costs.seconds({24, 8, 8, 16}) == 3 * 128.0, nearly);
  BOOST_TEST(costs.seconds({32, 8, 16, 16}) == 256.0, nearly);
}

BOOST_AUTO_TEST_CASE(another_shape_is_refused) {
  const auto wide = tiles_of({0, 0, 64, 48}, 16, left_is_dear);
  for (const render::Rect& picture : {render::Rect{0, 0, 64, 64}, {0, 0, 640, 460}, {0, 0, 48, 64}}) {
    try {
      CostMap(wide, picture, picture, "t.csv");
      BOOST_ERROR("taken for " << picture.width << "x" << picture.height);
    } catch (const io::Error& error) {
      BOOST_TEST(std::string(error.what()).find("t.csv:1:1: the tiles make a picture of 64x48") == 0u);
    }
  }
  // Sides are whole, so the other resolution's shape may be a pixel off.
  const render::Rect third{0, 0, 21, 16};
  BOOST_CHECK_NO_THROW(CostMap(wide, third, third, "t.csv"));
}

BOOST_AUTO_TEST_SUITE_END()
