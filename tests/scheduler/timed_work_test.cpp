// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/timed_work.h"

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <thread>

namespace tessera::scheduler {
namespace {

constexpr std::uint64_t kServingNs = 10'000'000;

}  // namespace

BOOST_AUTO_TEST_SUITE(timed_work)

BOOST_AUTO_TEST_CASE(the_result_is_the_works_own) {
  const Work work = [](TaskId task, const auto&) { return Bytes(index_of(task), std::byte{5}); };
  const Stopwatch clock;
  TimedWork timed(work, clock, [] {});
  BOOST_TEST((timed.run(TaskId{3}).payload == Bytes(3, std::byte{5})));
}

BOOST_AUTO_TEST_CASE(time_spent_on_messages_is_not_counted_as_busy) {
  const Work work = [](TaskId, const auto& between_slices) {
    between_slices();
    between_slices();
    return Bytes();
  };
  const Stopwatch clock;
  TimedWork timed(work, clock, [] { std::this_thread::sleep_for(std::chrono::nanoseconds(kServingNs)); });
  for (int task = 0; task < 2; ++task) {
    const TimedResult result = timed.run(TaskId{0});
    const std::uint64_t elapsed_ns = clock.elapsed_ns() - result.start_ns;
    BOOST_TEST(elapsed_ns >= result.busy_ns + 2 * kServingNs);
  }
}

BOOST_AUTO_TEST_CASE(serving_never_begins_inside_itself) {
  int depth = 0;
  int served = 0;
  std::function<void()> again;
  const Work work = [&](TaskId, const auto& between_slices) {
    again = between_slices;
    between_slices();
    between_slices();
    return Bytes();
  };
  const Stopwatch clock;
  TimedWork timed(work, clock, [&] {
    BOOST_TEST(++depth == 1);
    if (depth == 1) again();
    ++served;
    --depth;
  });
  timed.run(TaskId{0});
  BOOST_TEST(served == 2);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
