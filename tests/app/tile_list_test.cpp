// SPDX-License-Identifier: BSD-3-Clause
#include "app/tile_list.h"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <vector>

#include "app/small_job.h"
#include "io/error.h"

using namespace tessera;
using namespace tessera::app;

BOOST_AUTO_TEST_SUITE(tile_list)

BOOST_AUTO_TEST_CASE(tiles_come_back_in_their_order) {
  const render::Rect area{3, 4, 50, 40};
  const auto tiles = test::uneven_tiles(area);
  const scheduler::Bytes bytes = encode_tiles(tiles);
  BOOST_TEST(bytes.size() == encoded_size(static_cast<std::uint32_t>(tiles.size())));
  const auto copy = decode_tiles(bytes, area);
  BOOST_TEST_REQUIRE(copy.size() == tiles.size());
  for (std::size_t i = 0; i != tiles.size(); ++i) {
    BOOST_TEST((copy[i].rect == tiles[i].rect));
    BOOST_TEST(copy[i].cost == static_cast<float>(tiles[i].cost));
  }
}

BOOST_AUTO_TEST_CASE(tiles_that_do_not_cover_the_area_once_are_refused) {
  const render::Rect area{8, 8, 16, 8};
  const render::CostedTile left{{8, 8, 8, 8}, 1}, right{{16, 8, 8, 8}, 1};
  BOOST_CHECK_NO_THROW(decode_tiles(encode_tiles(std::vector{left, right}), area));
  const auto is_refused = [&](const std::vector<render::CostedTile>& tiles) {
    BOOST_CHECK_THROW(decode_tiles(encode_tiles(tiles), area), io::Error);
  };
  is_refused({});
  is_refused({left});
  is_refused({left, left});
  is_refused({left, right, right});
  is_refused({left, {{24, 8, 8, 8}, 1}});
  is_refused({left, {{16, 0, 8, 8}, 1}});
  is_refused({left, {{16, 8, 8, 0}, 1}, right});
  is_refused({left, {{16, 8, 0xffffffff, 8}, 1}});
  is_refused({left, {{0xffffffff, 8, 8, 8}, 1}});
  is_refused({left, {{16, 8, 8, 8}, -1}});
  is_refused({left, {{16, 8, 8, 8}, std::numeric_limits<double>::quiet_NaN()}});
}

BOOST_AUTO_TEST_CASE(bytes_cut_off_anywhere_are_refused) {
  const render::Rect area{0, 0, 40, 40};
  const scheduler::Bytes bytes = encode_tiles(test::uneven_tiles(area));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    BOOST_CHECK_THROW(decode_tiles(std::span(bytes).first(size), area), io::Error);
  }
}

BOOST_AUTO_TEST_SUITE_END()
