// SPDX-License-Identifier: BSD-3-Clause
#include "io/tile_stats_file.h"

#include <boost/test/unit_test.hpp>

#include "io/error.h"

namespace tessera::io {
namespace {

const std::string kHeader = "tile,x,y,width,height,rank,start_s,end_s,rays,bytes\n";

/// What is wrong with a text, "" where nothing is.
std::string problem_with(const std::string& text) {
  try {
    parse_tile_stats(text, "costs.csv");
  } catch (const Error& error) {
    BOOST_TEST((error.kind() == ErrorKind::bad_scene));
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tile_stats_file)

BOOST_AUTO_TEST_CASE(what_was_written_is_read_back) {
  const std::vector<TileRow> rows{{0, 0, 0, 16, 8, 3, 0.125, 0.25, 512, 400},
                                  {7, 16, 8, 1, 2, 0, 0.1, 1e-7 + 0.1, 9, 22}};
  const auto read = parse_tile_stats(tile_stats_csv(rows), "costs.csv");
  BOOST_TEST(tile_stats_csv(read) == tile_stats_csv(rows));
  BOOST_TEST(read[1].end_s == rows[1].end_s);
}

BOOST_AUTO_TEST_CASE(the_last_line_need_not_end) {
  BOOST_TEST(parse_tile_stats(kHeader + "0,0,0,8,8,0,0,1,64,208", "costs.csv").size() == 1U);
}

BOOST_AUTO_TEST_CASE(another_file_is_refused_with_the_place) {
  BOOST_TEST(problem_with("x y z r\n1 2 3 4\n").starts_with("costs.csv:1:1: \"x y z r\" stands where"));
  BOOST_TEST(problem_with("tile,x,y,w,height,rank,start_s,end_s,rays,bytes\n").starts_with("costs.csv:1:10: \"w\""));
  BOOST_TEST(problem_with("").starts_with("costs.csv:1:1: there are no tiles"));
  BOOST_TEST(problem_with(kHeader).starts_with("costs.csv:2:1: there are no tiles"));
}

BOOST_AUTO_TEST_CASE(a_bad_field_is_refused_with_its_place) {
  BOOST_TEST(problem_with(kHeader + "0,0,0,8,8,0,0,1,64,208\n1,8,z,8,8,0,0,1,64,208\n").starts_with("costs.csv:3:5: "));
  BOOST_TEST(problem_with(kHeader + "0,0,0,0,8,0,0,1,64,208\n").starts_with("costs.csv:2:7: "));
  BOOST_TEST(problem_with(kHeader + "0,0,4294967290,8,8,0,0,1,64,208\n").starts_with("costs.csv:2:18: "));
  BOOST_TEST(problem_with(kHeader + "0,0,0,8,8,0,2,1,64,208\n").starts_with("costs.csv:2:15: "));
  BOOST_TEST(problem_with(kHeader + "0,0,0,8,8,0,0,inf,64,208\n").starts_with("costs.csv:2:15: "));
  BOOST_TEST(problem_with(kHeader + "0,0,0,8,8,0,0,1,64\n").starts_with("costs.csv:2:"));
  BOOST_TEST(problem_with(kHeader + "0,0,0,8,8,0,0,1,64,208,5\n").starts_with("costs.csv:2:"));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
