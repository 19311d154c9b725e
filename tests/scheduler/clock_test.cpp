// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/clock.h"

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <thread>

namespace tessera::scheduler {

BOOST_AUTO_TEST_SUITE(clock)

BOOST_AUTO_TEST_CASE(without_another_clock_time_is_the_systems) {
  const std::uint64_t before_ns = now_ns();
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  BOOST_TEST(now_ns() - before_ns >= 2'000'000U);
}

BOOST_AUTO_TEST_CASE(a_clock_in_place_counts_until_it_ends) {
  {
    const ClockInPlace seven([]() noexcept -> std::uint64_t { return 7; });
    BOOST_TEST(now_ns() == 7U);
    {
      const ClockInPlace eight([]() noexcept -> std::uint64_t { return 8; });
      BOOST_TEST(now_ns() == 8U);
    }
    BOOST_TEST(now_ns() == 7U);
  }
  BOOST_TEST(now_ns() > 8U);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
