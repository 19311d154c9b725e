// SPDX-License-Identifier: BSD-3-Clause
#include "io/nest_slices.h"

#include <boost/test/unit_test.hpp>
#include <ostream>
#include <random>
#include <vector>

namespace tessera::io {
namespace {

struct Times {
  std::uint64_t begin_ns;
  std::uint64_t end_ns;
  friend bool operator==(const Times&, const Times&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Times& t) { return out << t.begin_ns << "-" << t.end_ns; }
};

// The times after nesting, in the order of `slices`.
std::vector<Times> nested(std::vector<Slice> slices) {
  for (std::size_t i = 0; i != slices.size(); ++i) slices[i].what = i;
  nest_slices(slices);
  std::vector<Times> times(slices.size());
  for (const Slice& slice : slices) times[slice.what] = {slice.begin_ns, slice.end_ns};
  return times;
}

void check(const std::vector<Slice>& slices, const std::vector<Times>& expected) {
  BOOST_TEST(nested(slices) == expected, boost::test_tools::per_element());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(NestSlices)

BOOST_AUTO_TEST_CASE(what_nests_already_stays) {
  check({{0, 100, 0}, {10, 50, 1}, {12, 20, 2}, {60, 90, 1}, {110, 120, 0}},
        {{0, 100}, {10, 50}, {12, 20}, {60, 90}, {110, 120}});
}

BOOST_AUTO_TEST_CASE(an_outer_slice_comes_first_in_whichever_order_they_were) {
  std::vector<Slice> slices{{10, 30, 2, 2}, {10, 90, 1, 1}, {0, 100, 0, 0}};
  nest_slices(slices);
  for (std::size_t i = 0; i != 3; ++i) BOOST_TEST(slices[i].what == i);
}

BOOST_AUTO_TEST_CASE(neighbours_keep_a_gap) {
  check({{0, 50, 1}, {50, 60, 1}, {61, 70, 1}}, {{0, 48}, {50, 59}, {61, 70}});
}

BOOST_AUTO_TEST_CASE(slices_of_one_level_never_overlap) {
  check({{0, 50, 1}, {30, 60, 1}}, {{0, 28}, {30, 60}});
}

BOOST_AUTO_TEST_CASE(an_inner_slice_ends_before_the_outer_one) {
  check({{0, 50, 0}, {30, 60, 1}}, {{0, 50}, {30, 48}});
  check({{0, 50, 0}, {30, 50, 1}, {40, 50, 2}}, {{0, 50}, {30, 48}, {40, 46}});
}

BOOST_AUTO_TEST_CASE(an_outer_slice_that_is_cut_takes_along_what_it_holds) {
  check({{0, 50, 0}, {10, 45, 1}, {40, 70, 0}}, {{0, 38}, {10, 38}, {40, 70}});
}

BOOST_AUTO_TEST_CASE(slices_without_a_length_get_one) {
  check({{0, 1, 0}, {0, 9, 1}}, {{0, 1}, {0, 1}});
  check({{5, 5, 0}, {5, 5, 0}, {5, 5, 1}}, {{5, 6}, {8, 9}, {8, 9}});
}

BOOST_AUTO_TEST_CASE(whatever_comes_in_nests_when_it_comes_out) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 5000; ++round) {
    const std::uint64_t range = 1 + random() % 300;
    std::vector<Slice> slices(random() % 30);
    for (Slice& slice : slices) {
      const std::uint64_t begin = random() % range;
      slice = {begin, begin + random() % range, static_cast<std::uint32_t>(random() % 3)};
    }
    nest_slices(slices);
    std::vector<Slice> around;
    std::uint64_t last_ns = 0;
    for (const Slice& slice : slices) {
      BOOST_REQUIRE_GE(slice.begin_ns, last_ns);
      last_ns = slice.begin_ns;
      BOOST_REQUIRE_LT(slice.begin_ns, slice.end_ns);
      while (!around.empty() && around.back().end_ns <= slice.begin_ns) around.pop_back();
      if (!around.empty()) {
        BOOST_REQUIRE_LE(slice.end_ns, around.back().end_ns);
        BOOST_REQUIRE_LT(around.back().level, slice.level);
      }
      around.push_back(slice);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
