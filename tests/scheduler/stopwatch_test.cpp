// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/stopwatch.h"

#include <boost/test/unit_test.hpp>

namespace tessera::scheduler {
namespace {

std::uint64_t told_ns = 0;

std::uint64_t told() noexcept {
  return told_ns;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(stopwatch)

BOOST_AUTO_TEST_CASE(counts_from_its_making_on_the_clock_in_place) {
  const ClockInPlace clock(told);
  told_ns = 1'000;
  const Stopwatch stopwatch;
  BOOST_TEST(stopwatch.elapsed_ns() == 0U);
  told_ns = 2'500'001'000;
  BOOST_TEST(stopwatch.elapsed_ns() == 2'500'000'000U);
  BOOST_TEST(stopwatch.seconds() == 2.5, boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
