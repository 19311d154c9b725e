// SPDX-License-Identifier: BSD-3-Clause
#include "app/coverage.h"

#include <boost/test/unit_test.hpp>

namespace tessera::app {

BOOST_AUTO_TEST_SUITE(CoverageTest)

BOOST_AUTO_TEST_CASE(a_tile_is_covered_when_its_last_pixel_is) {
  Coverage coverage({10, 20, 100, 50});
  const render::Rect tile{12, 21, 8, 4};
  BOOST_TEST(!coverage.covers(tile));
  coverage.add({12, 21, 8, 3});
  coverage.add({12, 24, 7, 1});
  BOOST_TEST(!coverage.covers(tile));
  coverage.add({19, 24, 1, 1});
  BOOST_TEST(coverage.covers(tile));
  BOOST_TEST(!coverage.covers({11, 21, 8, 4}));
  BOOST_TEST(!coverage.covers({12, 20, 8, 4}));
}

BOOST_AUTO_TEST_CASE(overlapping_tiles_cover_as_well) {
  Coverage coverage({0, 0, 16, 16});
  for (const render::Rect& tile : {render::Rect{0, 0, 10, 16}, {6, 0, 10, 9}, {5, 8, 11, 8}}) coverage.add(tile);
  BOOST_TEST(coverage.covers({0, 0, 16, 16}));
}

BOOST_AUTO_TEST_CASE(every_pixel_of_an_area_counts_alone) {
  const render::Rect area{3, 5, 13, 7};
  for (std::uint32_t y = area.y; y != area.y + area.height; ++y) {
    for (std::uint32_t x = area.x; x != area.x + area.width; ++x) {
      Coverage coverage(area);
      coverage.add({x, y, 1, 1});
      BOOST_TEST(coverage.covers({x, y, 1, 1}));
      BOOST_TEST((x + 1 == area.x + area.width || !coverage.covers({x, y, 2, 1})));
      BOOST_TEST((x == area.x || !coverage.covers({x - 1, y, 1, 1})));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::app
