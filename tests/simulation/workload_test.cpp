// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/workload.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <numeric>
#include <stdexcept>

#include "simulation/cost_map.h"

namespace tessera::simulation {

BOOST_AUTO_TEST_SUITE(workload)

BOOST_AUTO_TEST_CASE(even_tiles_make_a_whole_picture) {
  for (const std::uint32_t tiles : {1U, 2U, 7U, 100U, 101U}) {
    const auto rows = tiles_of({.tiles = tiles, .mean_s = 0.5, .spread = 0, .bytes = 20});
    BOOST_TEST(rows.size() >= tiles);
    BOOST_TEST(rows.size() - tiles <= 1 + rows.back().x / kEvenTileSize);
    const CostMap map(rows);
    const CostMap::Cost all = map.of({0, 0, map.width(), map.height()}, {0, 0, map.width(), map.height()});
    BOOST_TEST(all.seconds == 0.5 * static_cast<double>(rows.size()), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(all.bytes == 20 * rows.size());
  }
}

BOOST_AUTO_TEST_CASE(uneven_tiles_fill_the_spread_around_the_mean) {
  const auto rows = tiles_of({.tiles = 10'000, .mean_s = 2, .spread = 0.25, .bytes = 1});
  const auto seconds = [](const io::TileRow& row) { return row.end_s - row.start_s; };
  const auto [least, most] = std::minmax_element(rows.begin(), rows.end(),
                                                 [&](const auto& a, const auto& b) { return seconds(a) < seconds(b); });
  BOOST_TEST(seconds(*least) >= 1.5);
  BOOST_TEST(seconds(*least) < 1.51);
  BOOST_TEST(seconds(*most) <= 2.5);
  BOOST_TEST(seconds(*most) > 2.49);
  const double sum =
      std::accumulate(rows.begin(), rows.end(), 0.0, [&](double s, const auto& row) { return s + seconds(row); });
  BOOST_TEST(sum / 10'000 == 2, boost::test_tools::tolerance(0.005));
}

BOOST_AUTO_TEST_CASE(equal_work_gives_equal_tiles) {
  const EvenWork work{.tiles = 50, .mean_s = 1, .spread = 1, .bytes = 1};
  BOOST_TEST(io::tile_stats_csv(tiles_of(work)) == io::tile_stats_csv(tiles_of(work)));
}

BOOST_AUTO_TEST_CASE(work_that_takes_no_time_is_refused) {
  BOOST_CHECK_THROW(tiles_of({.tiles = 0, .mean_s = 1}), std::invalid_argument);
  BOOST_CHECK_THROW(tiles_of({.tiles = 1, .mean_s = 0}), std::invalid_argument);
  BOOST_CHECK_THROW(tiles_of({.tiles = 1, .mean_s = 1, .spread = 1.5}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::simulation
