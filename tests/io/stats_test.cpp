// SPDX-License-Identifier: BSD-3-Clause
#include "io/stats.h"

#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using test::error_of;
using test::slurp;

// JSON without the blanks between its parts; the values under test hold none.
std::string packed_json(const Stats& stats) {
  std::string packed;
  for (const char c : to_json(stats)) {
    if (c != ' ' && c != '\n') packed += c;
  }
  return packed;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(StatsTest)

BOOST_AUTO_TEST_CASE(json_has_every_key_that_scripts_rely_on) {
  Stats stats;
  stats.version = "1.2.3";
  stats.command = "render";
  stats.scene = {1, 2, 3, 4};
  stats.image = {5, 6, 7, 8};
  stats.mpi = {9, 10, "OpenMPI"};
  stats.schedule = {"dynamic", 11, 12, 13, 14, "auto", 14.5, 25};
  stats.memory = {70.5, 25, 26};
  stats.time_s = {0.5, 1.5, 2.5, 3.5, 4.5, 5.5};
  stats.rays = {15, 16, 17};
  stats.skipped = {{"shadow", 18}};
  stats.ranks = {{19, "node", 20, 21, 22, 6.5, 7.5}};
  stats.balance = {8.5, 9.5, 10.5, 11.5, 12.5, 13.5};
  stats.messages = {23, 24, 15.5, 16.5, 17.5};
  stats.faults = {25, 26, 27, 28, 29, 14.5, {30, 31}};
  BOOST_TEST(
      packed_json(stats) ==
      R"({"balance":{"efficiency":10.5,"graham_bound_s":12.5,"imbalance":8.5,"load_balance":9.5,)"
      R"("makespan_s":13.5,"tail_s":11.5},"command":"render",)"
      R"("faults":{"damaged":27,"late":28,"lost":[30,31],"reissued":26,"returned":29,"silences":25,"wasted_s":14.5},)"
      R"("image":{"height":6,"max_bounces":8,"samples":7,"width":5},"memory":{"bytes_per_sphere":70.5,"node_bytes":25,"rank_bytes":26},)"
      R"("messages":{"bytes":24,"bytes_per_tile":16.5,"count":23,"master_s_per_tile":17.5,"per_tile":15.5},)"
      R"("mpi":{"library":"OpenMPI","nodes":10,"size":9},)"
      R"("ranks":[{"busy_s":6.5,"host":"node","pixels":21,"rank":19,"rays":22,"tiles":20,"wait_s":7.5}],)"
      R"("rays":{"mirror":17,"primary":15,"shadow":16},)"
      R"("scene":{"lights":3,"materials":4,"planes":2,"spheres":1},)"
      R"("schedule":{"master":"auto","policy":"dynamic","prefetch":14,"prefetch_mean":14.5,)"
      R"("prefetch_most":25,"tile_height":12,"tile_width":11,)"
      R"("tiles":13},"schema":1,"skipped":{"shadow":18},)"
      R"("time_s":{"broadcast":1.5,"build":2.5,"read":0.5,"render":3.5,"total":5.5,"write":4.5},)"
      R"("version":"1.2.3"})");
}

BOOST_AUTO_TEST_CASE(json_tells_of_a_journal_only_where_one_was_resumed) {
  Stats stats;
  BOOST_TEST(!contains(packed_json(stats), "resumed"));
  stats.resumed = {25, 26, 27};
  BOOST_TEST(contains(packed_json(stats), R"("resumed":{"pixels":26,"rays":27,"tiles":25},)"));
}

BOOST_AUTO_TEST_CASE(json_strings_are_escaped) {
  Stats stats;
  stats.command = "a\"b\\c\nd\te\x01\u00e9";
  const std::string json = packed_json(stats);
  BOOST_TEST(contains(json, R"("command":"a\"b\\c\nd\te\u0001)"), json);
}

BOOST_AUTO_TEST_CASE(json_numbers_keep_their_digits) {
  Stats stats;
  stats.rays.primary = std::uint64_t{1} << 62;
  stats.rays.shadow = (std::uint64_t{1} << 53) + 1;
  stats.time_s.render = 0.1;
  stats.time_s.total = 1.0 / 3;
  stats.time_s.read = 1e-9;
  const std::string json = packed_json(stats);
  BOOST_TEST(contains(json, "\"primary\":4611686018427387904"), json);
  BOOST_TEST(contains(json, "\"shadow\":9007199254740993"), json);
  for (const auto& [key, value] : {std::pair{"render", 0.1}, {"total", 1.0 / 3}, {"read", 1e-9}}) {
    const std::size_t at = json.find('"' + std::string(key) + "\":");
    BOOST_TEST_REQUIRE(at != std::string::npos);
    BOOST_TEST(std::stod(json.substr(at + std::string(key).size() + 3)) == value);
  }
}

BOOST_AUTO_TEST_CASE(a_number_that_is_not_finite_becomes_a_string) {
  Stats stats;
  stats.balance.imbalance = std::numeric_limits<double>::infinity();
  stats.balance.efficiency = std::numeric_limits<double>::quiet_NaN();
  const std::string json = packed_json(stats);
  BOOST_TEST(contains(json, "\"imbalance\":\"Infinity\""), json);
  BOOST_TEST(contains(json, "\"efficiency\":\"NaN\""), json);
}

BOOST_AUTO_TEST_CASE(a_count_beyond_63_bits_is_refused) {
  Stats stats;
  stats.messages.bytes = std::numeric_limits<std::uint64_t>::max();
  BOOST_CHECK_THROW(to_json(stats), std::out_of_range);
}

BOOST_AUTO_TEST_CASE(csv_has_a_line_for_each_tile) {
  const TileRow rows[] = {{0, 0, 0, 16, 8, 1, 0.125, 0.25, 1000, 384}, {7, 16, 8, 3, 2, 2, 1e-7, 1.0 / 3, 5, 18}};
  BOOST_TEST(tile_stats_csv(rows) ==
             "tile,x,y,width,height,rank,start_s,end_s,rays,bytes\n"
             "0,0,0,16,8,1,0.125,0.25,1000,384\n"
             "7,16,8,3,2,2,1e-07,0.3333333333333333,5,18\n");
}

BOOST_AUTO_TEST_CASE(text_goes_to_a_file_or_to_standard_output) {
  const test::TempFolder folder;
  write_text(folder / "stats.json", "{}\n");
  BOOST_TEST(slurp(folder / "stats.json") == "{}\n");
  write_text("-", "");
  BOOST_TEST(!std::filesystem::exists("-"));
  const auto error = error_of([&] { write_text(folder / "no/such", "x"); });
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST((error->kind() == ErrorKind::cannot_create));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
