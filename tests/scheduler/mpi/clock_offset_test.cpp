// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/clock_offset.h"

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include "scheduler/mpi/session_for_tests.h"
#include "scheduler/mpi/transport.h"

namespace tessera::scheduler::mpi {
namespace {

using std::chrono::steady_clock;

// Makes a stopwatch, and says on the clock that all ranks of a machine share when that was, between two readings.
struct Started {
  steady_clock::rep before_ns = steady_clock::now().time_since_epoch().count();
  Stopwatch clock;
  steady_clock::rep after_ns = steady_clock::now().time_since_epoch().count();
};

struct Interval {
  steady_clock::rep before_ns;
  steady_clock::rep after_ns;
};

// What every rank says of its start, on rank 0.
std::vector<Interval> gather(const Started& started) {
  Session& session = session_for_tests();
  const Interval mine{started.before_ns, started.after_ns};
  MpiTransport transport(session);
  std::vector<Interval> all(session.size(), mine);
  if (session.rank() != kMasterRank) {
    Bytes bytes(sizeof mine);
    std::memcpy(bytes.data(), &mine, sizeof mine);
    transport.send(kMasterRank, std::move(bytes));
  } else {
    for (std::uint32_t missing = session.size() - 1; missing != 0;) {
      const auto envelope = transport.receive();
      if (!envelope) continue;
      std::memcpy(&all[envelope->source], envelope->bytes.data(), sizeof mine);
      --missing;
    }
  }
  transport.flush();
  session.barrier();
  return all;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(clock_offset)

BOOST_AUTO_TEST_CASE(the_offsets_of_clocks_that_start_apart_are_found_within_their_uncertainty) {
  Session& session = session_for_tests();
  session.barrier();
  // Rank 1 starts last of three and rank 2 first, by 20 ms each
  std::this_thread::sleep_for(std::chrono::milliseconds(20) * ((session.rank() + 1) % 3));
  const Started started;
  session.barrier();
  const std::vector<ClockOffset> offsets = measure_clock_offsets(session, started.clock);
  const std::vector<Interval> starts = gather(started);
  if (session.rank() != kMasterRank) {
    BOOST_TEST(offsets.empty());
    return;
  }
  BOOST_REQUIRE_EQUAL(offsets.size(), session.size());
  BOOST_TEST(offsets[0].offset_s == 0.0);
  BOOST_TEST(offsets[0].uncertainty_s == 0.0);
  for (Rank rank = 1; rank != session.size(); ++rank) {
    BOOST_TEST_CONTEXT("rank " << rank) {
      const double least_s = 1e-9 * static_cast<double>(starts[rank].before_ns - starts[0].after_ns);
      const double most_s = 1e-9 * static_cast<double>(starts[rank].after_ns - starts[0].before_ns);
      BOOST_TEST(offsets[rank].offset_s >= least_s - offsets[rank].uncertainty_s - 1e-9);
      BOOST_TEST(offsets[rank].offset_s <= most_s + offsets[rank].uncertainty_s + 1e-9);
      BOOST_TEST(offsets[rank].uncertainty_s > 0.0);
      BOOST_TEST(offsets[rank].uncertainty_s < 10e-3);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_run_can_follow_at_once_with_its_own_messages) {
  Session& session = session_for_tests();
  session.barrier();
  const Stopwatch clock;
  const auto offsets = measure_clock_offsets(session, clock);
  MpiTransport transport(session);
  BOOST_TEST(!transport.receive().has_value());
  session.barrier();
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler::mpi
