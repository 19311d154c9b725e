// SPDX-License-Identifier: BSD-3-Clause
#include "io/tile_times.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "io/error.h"
#include "io/stats.h"

using namespace tessera;
using namespace tessera::io;

namespace {

const std::string kHeader = "tile,x,y,width,height,rank,start_s,end_s,rays,bytes\n";

std::string complaint(const std::string& text) {
  try {
    parse_tile_times(text, "t.csv");
  } catch (const Error& error) {
    BOOST_TEST((error.kind() == ErrorKind::bad_scene));
    return error.what();
  }
  return "none";
}

bool begins(const std::string& text, const std::string& with) {
  return text.rfind(with, 0) == 0;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tile_times)

BOOST_AUTO_TEST_CASE(what_tile_statistics_say_is_read_back) {
  const std::vector<TileRow> rows{{0, 4, 2, 16, 8, 1, 0.25, 1.5, 7, 8}, {1, 20, 2, 3, 8, 0, 1e-6, 3e-6, 7, 8}};
  const auto tiles = parse_tile_times(tile_stats_csv(rows), "t.csv");
  BOOST_TEST_REQUIRE(tiles.size() == 2u);
  BOOST_TEST((tiles[0].rect == render::Rect{4, 2, 16, 8}));
  BOOST_TEST(tiles[0].seconds == 1.25);
  BOOST_TEST((tiles[1].rect == render::Rect{20, 2, 3, 8}));
  BOOST_TEST(tiles[1].seconds == 2e-6, boost::test_tools::tolerance(1e-12));
  BOOST_TEST((bounds_of(tiles) == render::Rect{4, 2, 19, 8}));
}

BOOST_AUTO_TEST_CASE(columns_are_found_by_their_names) {
  const auto tiles = parse_tile_times("end_s,more,height,width,y,x,start_s\r\n3,?,5,4,0,0,1\r\n", "t.csv");
  BOOST_TEST_REQUIRE(tiles.size() == 1u);
  BOOST_TEST((tiles[0].rect == render::Rect{0, 0, 4, 5}));
  BOOST_TEST(tiles[0].seconds == 2.0);
}

BOOST_AUTO_TEST_CASE(a_foreign_file_is_refused_with_its_first_line) {
  BOOST_TEST(begins(complaint("[image]\nwidth = 5\n"), "t.csv:1:1: no column \"x\""));
  BOOST_TEST(begins(complaint("tile,x,y,width,height,rank,start_s,rays\n"), "t.csv:1:1: no column \"end_s\""));
  BOOST_TEST(begins(complaint(""), "t.csv:1:1: the file is empty"));
  BOOST_TEST(begins(complaint(kHeader), "t.csv:1:1: there are no tiles"));
}

BOOST_AUTO_TEST_CASE(a_bad_value_is_refused_with_its_place) {
  const std::string good = "0,0,0,8,8,0,0,1,0,0\n";
  const auto after_good = [&](const std::string& row) { return complaint(kHeader + good + row); };
  BOOST_TEST(begins(after_good("1,8,0,8,8,0,0\n"), "t.csv:3:1: 7 values (there are 10 columns)"));
  BOOST_TEST(begins(after_good("1,8,0,x,8,0,0,1,0,0\n"), "t.csv:3:7: \"x\" is not a number"));
  BOOST_TEST(begins(after_good("1,8,0,,8,0,0,1,0,0\n"), "t.csv:3:7: \"\" is not a number"));
  BOOST_TEST(begins(after_good("1,8,0,0,8,0,0,1,0,0\n"), "t.csv:3:7: \"0\" is not a number of pixels"));
  BOOST_TEST(begins(after_good("1,-8,0,8,8,0,0,1,0,0\n"), "t.csv:3:3: \"-8\" is not a number of pixels"));
  BOOST_TEST(begins(after_good("1,8.5,0,8,8,0,0,1,0,0\n"), "t.csv:3:3: \"8.5\" is not a number of pixels"));
  BOOST_TEST(begins(after_good("1,1e30,0,8,8,0,0,1,0,0\n"), "t.csv:3:3: \"1e30\" is not a number of pixels"));
  BOOST_TEST(begins(after_good("1,8,0,8,8,0,2,1,0,0\n"), "t.csv:3:15: the time from start_s to end_s is not"));
  BOOST_TEST(begins(after_good("1,8,0,8,8,0,nan,1,0,0\n"), "t.csv:3:13: \"nan\" is not a number"));
  BOOST_TEST(begins(after_good("1,8,0,8,8,0,-1e308,1e308,0,0\n"), "t.csv:3:20: the time from start_s to end_s"));
}

BOOST_AUTO_TEST_CASE(tiles_must_fill_a_rectangle) {
  const std::string one = "0,0,0,8,8,0,0,1,0,0\n";
  BOOST_TEST(begins(complaint(kHeader + one + one), "t.csv:1:1: the tiles do not fill a rectangle"));
  BOOST_TEST(begins(complaint(kHeader + one + "1,16,0,8,8,0,0,1,0,0\n"), "t.csv:1:1: the tiles do not fill"));
}

BOOST_AUTO_TEST_CASE(a_file_that_is_not_there_is_missing) {
  try {
    read_tile_times("no/such/file.csv");
    BOOST_ERROR("read");
  } catch (const Error& error) {
    BOOST_TEST((error.kind() == ErrorKind::input_missing));
  }
}

BOOST_AUTO_TEST_SUITE_END()
