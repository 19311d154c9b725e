// SPDX-License-Identifier: BSD-3-Clause
#include "io/rank_colors.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <set>

#include "io/oklab.h"

namespace tessera::io {
namespace {

double least_distance(const std::vector<Rgb8>& colors) {
  double least = 1;
  for (std::size_t i = 0; i != colors.size(); ++i) {
    for (std::size_t j = 0; j != i; ++j) {
      least = std::min(least, distance_between(oklab_of(colors[i]), oklab_of(colors[j])));
    }
  }
  return least;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(RankColors)

BOOST_AUTO_TEST_CASE(few_ranks_are_easy_to_tell_apart_and_many_still_can_be) {
  BOOST_TEST(least_distance(rank_colors(4)) > 0.3);
  BOOST_TEST(least_distance(rank_colors(16)) > 0.17);
  BOOST_TEST(least_distance(rank_colors(64)) > 0.09);
  const auto many = rank_colors(631);
  BOOST_TEST((std::set<Rgb8>(many.begin(), many.end()).size() == 631U));
}

BOOST_AUTO_TEST_CASE(a_rank_has_the_same_color_among_few_and_many) {
  const auto many = rank_colors(2000);
  for (const std::uint32_t count : {0U, 1U, 2U, 17U, 700U}) {
    const auto few = rank_colors(count);
    BOOST_TEST(few.size() == count);
    BOOST_TEST(std::equal(few.begin(), few.end(), many.begin()));
  }
  BOOST_TEST((many[631] == many[0]));
  BOOST_TEST((many[1270] == many[8]));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
