// SPDX-License-Identifier: BSD-3-Clause
#include "app/open_tiles.h"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "app/coverage.h"
#include "render/tile.h"

namespace tessera::app {
namespace {

constexpr render::Rect kArea{0, 0, 40, 25};

std::vector<render::Rect> all_tiles() {
  return render::tile_grid(kArea, 7, 6);  // 6 x 5
}

}  // namespace

BOOST_AUTO_TEST_SUITE(OpenTiles)

BOOST_AUTO_TEST_CASE(without_marks_all_tiles_are_open) {
  BOOST_TEST((open_tiles(all_tiles(), {}) == all_tiles()));
}

BOOST_AUTO_TEST_CASE(a_tile_stays_open_while_a_pixel_of_it_is_missing) {
  Coverage coverage(kArea);
  BOOST_TEST((open_tiles(all_tiles(), mark_open(all_tiles(), coverage)) == all_tiles()));
  coverage.add({0, 0, 40, 11});  // a row of tiles and most of the next
  auto expected = all_tiles();
  expected.erase(expected.begin(), expected.begin() + 6);
  BOOST_TEST((open_tiles(all_tiles(), mark_open(all_tiles(), coverage)) == expected));
  coverage.add({7, 11, 7, 1});
  expected.erase(expected.begin() + 1);
  BOOST_TEST((open_tiles(all_tiles(), mark_open(all_tiles(), coverage)) == expected));
  coverage.add(kArea);
  BOOST_TEST(open_tiles(all_tiles(), mark_open(all_tiles(), coverage)).empty());
}

BOOST_AUTO_TEST_CASE(marks_of_other_tiles_are_refused) {
  const scheduler::Bytes marks = mark_open(all_tiles(), Coverage(kArea));
  BOOST_TEST(marks.size() == 4u);
  BOOST_CHECK_THROW(open_tiles(render::tile_grid(kArea, 8, 8), marks), std::runtime_error);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::app
