// SPDX-License-Identifier: BSD-3-Clause
#include "app/tile_size.h"

#include <boost/test/unit_test.hpp>

using namespace tessera;
using namespace tessera::app;

namespace {

std::pair<std::uint32_t, std::uint32_t> size_for(std::uint32_t side, double samples) {
  const Size size = tile_size_without_costs({0, 0, side, side}, samples);
  return {size.width, size.height};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tile_size)

// sqrt(A 3 us / (6 s 0.3 us)) = 1.29 sqrt(A / s) pixels, rounded to a power of two.
BOOST_AUTO_TEST_CASE(tiles_grow_with_the_root_of_the_area) {
  BOOST_TEST((size_for(512, 1) == std::pair{32u, 16u}));   // 661
  BOOST_TEST((size_for(1024, 1) == std::pair{32u, 32u}));  // 1322
  BOOST_TEST((size_for(2048, 1) == std::pair{64u, 32u}));  // 2644
  BOOST_TEST((size_for(4096, 1) == std::pair{64u, 64u}));  // 5288
  const Size hd = tile_size_without_costs({0, 0, 1920, 1080}, 1);
  BOOST_TEST((hd.width == 64u && hd.height == 32u));  // 1859
}

BOOST_AUTO_TEST_CASE(samples_make_tiles_smaller) {
  BOOST_TEST((size_for(1024, 4) == std::pair{32u, 16u}));
  BOOST_TEST((size_for(1024, 16) == std::pair{16u, 16u}));
}

BOOST_AUTO_TEST_CASE(tiles_stay_between_8x8_and_128x128) {
  BOOST_TEST((size_for(1, 1) == std::pair{8u, 8u}));
  BOOST_TEST((size_for(64, 10000) == std::pair{8u, 8u}));
  BOOST_TEST((size_for(60000, 1) == std::pair{128u, 128u}));
}

BOOST_AUTO_TEST_CASE(bands_do_where_there_are_few_tiles_or_little_work) {
  const render::Rect picture{0, 0, 1024, 1024};
  BOOST_TEST(!bands_will_do(picture, 1, 1));
  BOOST_TEST(!bands_will_do(picture, 1, 2));
  // x = 0.315 s / (P^2 3 us) is 6.1 at 131 ranks and 5.9 at 133.
  BOOST_TEST(!bands_will_do(picture, 1, 131));
  BOOST_TEST(bands_will_do(picture, 1, 133));
  BOOST_TEST(!bands_will_do(picture, 4, 133));
  // 8x8 pixels are a tile, 16x16 four.
  BOOST_TEST(!bands_will_do({0, 0, 8, 8}, 1, 1));
  BOOST_TEST(bands_will_do({0, 0, 8, 8}, 1, 2));
  BOOST_TEST(!bands_will_do({0, 0, 16, 16}, 1, 2));
  BOOST_TEST(bands_will_do({0, 0, 24, 8}, 100, 2));
  BOOST_TEST(!bands_will_do({0, 0, 32, 8}, 100, 2));
}

BOOST_AUTO_TEST_SUITE_END()
