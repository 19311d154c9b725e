// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/clock_offset.h"

#include <array>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <thread>
#include <vector>

namespace tessera::scheduler {
namespace {

constexpr double kTight = 1e-9;

// Rank 0 and rank 1, and tasks of rank 1: assigned, start, end and received, in seconds on the clocks of their ranks.
RunRecord two_ranks(const std::vector<std::array<double, 4>>& tasks) {
  RunRecord run;
  run.ranks.resize(2);
  run.ranks[1].rank = 1;
  for (const auto& [assigned, start, end, received] : tasks) {
    TaskRecord task;
    task.rank = 1;
    task.assigned_s = assigned;
    task.start_s = start;
    task.end_s = end;
    task.received_s = received;
    run.tasks.push_back(task);
  }
  return run;
}

// The offset of rank 1 where `measured` was measured.
double set_offset(const std::vector<std::array<double, 4>>& tasks, double measured) {
  RunRecord run = two_ranks(tasks);
  set_clock_offsets(run, std::vector<ClockOffset>{{}, {measured, 0.25}}, run.clock);
  BOOST_TEST(run.ranks[0].clock_offset_s == 0.0);
  BOOST_TEST(run.ranks[1].clock_uncertainty_s == 0.25);
  return run.ranks[1].clock_offset_s;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(clock_offset)

BOOST_AUTO_TEST_CASE(one_reading_is_taken_in_the_middle_of_its_round_trip) {
  const std::vector<ClockReading> readings{{1000, 50'000, 3000}};
  const ClockOffset offset = offset_from(readings);
  BOOST_CHECK_CLOSE(offset.offset_s, (2000 - 50'000) * 1e-9, kTight);
  BOOST_CHECK_CLOSE(offset.uncertainty_s, 1e-6, kTight);
}

BOOST_AUTO_TEST_CASE(the_shortest_round_trip_decides) {
  const std::vector<ClockReading> readings{{0, 700, 4000}, {5000, 2000, 5600}, {9000, 900, 9700}};
  BOOST_CHECK_CLOSE(offset_from(readings).offset_s, 3300e-9, kTight);
  BOOST_CHECK_CLOSE(offset_from(readings).uncertainty_s, 300e-9, kTight);
}

BOOST_AUTO_TEST_CASE(a_known_offset_is_found_within_its_uncertainty_however_uneven_the_ways_are) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 2000; ++round) {
    const std::int64_t offset_ns = static_cast<std::int64_t>(random() % 2'000'000'000) - 1'000'000'000;
    std::vector<ClockReading> readings;
    std::uint64_t now_ns = 2'000'000'000;
    for (int i = 0; i < 8; ++i) {
      const std::uint64_t there_ns = random() % 50'000;
      const std::uint64_t back_ns = random() % 50'000;
      const auto read_ns = static_cast<std::uint64_t>(static_cast<std::int64_t>(now_ns + there_ns) - offset_ns);
      readings.push_back({now_ns, read_ns, now_ns + there_ns + back_ns});
      now_ns += there_ns + back_ns + 100;
    }
    const ClockOffset found = offset_from(readings);
    BOOST_REQUIRE_LE(std::abs(found.offset_s - static_cast<double>(offset_ns) * 1e-9), found.uncertainty_s + 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(an_offset_that_contradicts_nothing_stays) {
  BOOST_TEST(set_offset({{0, 1, 2, 3}}, 0.5) == 0.5);
  BOOST_TEST(set_offset({{0, 1, 2, 3}}, -1.0) == -1.0);
  BOOST_TEST(set_offset({}, 7.0) == 7.0);
}

BOOST_AUTO_TEST_CASE(an_offset_is_moved_until_each_task_lies_between_its_assignment_and_its_return) {
  BOOST_TEST(set_offset({{1, 2, 3, 4}}, -1.5) == -1.0);
  BOOST_TEST(set_offset({{0, 1, 2, 3}}, 1.5) == 1.0);
  BOOST_TEST(set_offset({{0, 1, 2, 3}, {2, 2.5, 4, 4.5}}, 9.0) == 0.5);
  BOOST_TEST(set_offset({{0, 1, 2, 3}, {2, 2.25, 4, 4.5}}, -9.0) == -0.25);
}

BOOST_AUTO_TEST_CASE(a_run_may_begin_after_the_clocks_were_compared) {
  const Stopwatch earlier;
  std::this_thread::sleep_for(std::chrono::milliseconds(3));
  RunRecord run = two_ranks({});
  set_clock_offsets(run, std::vector<ClockOffset>{{}, {0.5, 0.25}}, earlier);
  BOOST_TEST(run.ranks[1].clock_offset_s <= 0.5 - 3e-3);
  BOOST_CHECK_SMALL(run.ranks[1].clock_offset_s + run.clock.seconds_after(earlier) - 0.5, 1e-12);
}

BOOST_AUTO_TEST_CASE(clocks_that_go_unequally_meet_in_the_middle) {
  BOOST_TEST(set_offset({{5, 4, 6, 9}, {20, 22, 27, 27.5}, {30, 31, 33, 31}}, 0.0) == -0.5);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
