// SPDX-License-Identifier: BSD-3-Clause
// A hundred thousand random histories against a model of the master's promises. Whatever happens, in whatever order:
// every task's own result is accepted once, nobody who cannot be counted on gets any, and every history ends.
#include <boost/test/unit_test.hpp>
#include <functional>

#include "scheduler/faulty_cluster.h"

namespace tessera::scheduler {
namespace {

// Sanitizers make a history twenty times as dear.
#ifdef __SANITIZE_ADDRESS__
constexpr std::uint64_t kHistories = 1000;
#else
constexpr std::uint64_t kHistories = 20'000;
#endif

void play_all(const Mishaps& mishaps, const std::function<void(const Outcome&)>& check) {
  for (std::uint64_t seed = 0; seed < kHistories; ++seed) {
    try {
      check(FaultyCluster(seed, mishaps).play());
    } catch (const BrokenPromise& broken) {
      BOOST_FAIL("seed " << seed << ": not kept: " << broken.what());
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(master_property)

BOOST_AUTO_TEST_CASE(where_nothing_goes_wrong_nothing_is_put_right) {
  Mishaps none;
  none.longest_delay = 0.05;
  std::uint64_t returned = 0;
  play_all(none, [&](const Outcome& outcome) {
    promise(outcome.given_up == 0, "nobody who goes home is given up");
    Faults expected;
    expected.returned = outcome.faults.returned;
    promise(outcome.faults == expected, "there are no faults where there are none");
    returned += outcome.faults.returned;
  });
  BOOST_TEST(returned > 0U);
}

BOOST_AUTO_TEST_CASE(who_dies_is_given_up_and_nobody_else) {
  Mishaps deaths;
  deaths.longest_delay = 0.05;
  deaths.dies = 0.4;
  std::uint64_t died = 0;
  std::uint64_t reissued = 0;
  play_all(deaths, [&](const Outcome& outcome) {
    promise(outcome.given_up == outcome.died, "the dead are given up and nobody else");
    promise(outcome.faults.silences <= outcome.died, "only the dead are silent");
    promise(outcome.faults.late == 0, "nothing comes from the dead");
    died += outcome.died;
    reissued += outcome.faults.reissued;
  });
  BOOST_TEST(died > kHistories / 4);
  BOOST_TEST(reissued > kHistories / 4);
}

BOOST_AUTO_TEST_CASE(who_stands_still_comes_back) {
  Mishaps stalls;
  stalls.longest_delay = 0.05;
  stalls.stalls = 0.5;
  stalls.longest_stall = 5;
  stalls.master_stalls = true;
  std::uint64_t late = 0;
  play_all(stalls, [&](const Outcome& outcome) { late += outcome.faults.late; });
  BOOST_TEST(late > kHistories / 100);
}

BOOST_AUTO_TEST_CASE(broken_results_do_not_get_in) {
  Mishaps rubbish;
  rubbish.longest_delay = 0.3;
  rubbish.damages = 0.15;
  rubbish.dies = 0.1;
  rubbish.answers_badly = true;
  std::uint64_t damaged = 0;
  play_all(rubbish, [&](const Outcome& outcome) { damaged += outcome.faults.damaged; });
  BOOST_TEST(damaged > kHistories / 2);
}

BOOST_AUTO_TEST_CASE(whatever_goes_wrong_no_promise_is_broken) {
  Mishaps all;
  all.loses = 0.03;
  all.doubles = 0.03;
  all.damages = 0.03;
  all.longest_delay = 0.6;
  all.reorders = true;
  all.answers_badly = true;
  all.dies = 0.2;
  all.stalls = 0.3;
  all.longest_stall = 4;
  all.mute = 0.1;
  all.longest_tick = 1.5;
  all.master_stalls = true;
  all.junk = 30;
  play_all(all, [](const Outcome&) {});
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
