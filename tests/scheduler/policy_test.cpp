// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/policy.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "scheduler/all_policies.h"

namespace tessera::scheduler {
namespace {

// A worker of eight ranks, with plenty left to do.
Standing worker() {
  Standing standing;
  standing.rank = 3;
  standing.ranks = 8;
  standing.backlog = {.tasks = 100000, .remaining = 100000};
  return standing;
}

std::uint32_t tasks_for(Policy policy, const Standing& standing) {
  return share_to_assign(policy, standing).tasks;
}

Standing worker_with_mean(double seconds) {
  Standing standing = worker();
  standing.mean_task_s = seconds;
  return standing;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(policy)

BOOST_AUTO_TEST_CASE(every_name_leads_back_to_its_policy) {
  const std::vector<std::string> names{"dynamic", "static-bands", "cyclic-rows", "self",
                                       "guided",  "factoring",    "trapezoid"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    BOOST_TEST(name_of(kAllPolicies[i]) == names[i]);
    BOOST_TEST((parse_policy(names[i]) == kAllPolicies[i]));
  }
}

BOOST_AUTO_TEST_CASE(other_names_are_no_policies) {
  for (const char* name : {"", "Dynamic", "self ", "static_bands", "factored"}) BOOST_TEST(!parse_policy(name));
}

BOOST_AUTO_TEST_CASE(only_bands_and_rows_have_owners) {
  BOOST_TEST(has_owners(Policy::static_bands));
  BOOST_TEST(has_owners(Policy::cyclic_rows));
  BOOST_TEST(!has_owners(Policy::dynamic));
  BOOST_TEST(!has_owners(Policy::self_scheduling));
  BOOST_TEST(!has_owners(Policy::guided));
  BOOST_TEST(!has_owners(Policy::factoring));
  BOOST_TEST(!has_owners(Policy::trapezoid));
}

BOOST_AUTO_TEST_CASE(self_scheduling_gives_one_task_to_a_rank_that_has_none) {
  Standing standing = worker_with_mean(1e-6);
  BOOST_TEST(tasks_for(Policy::self_scheduling, standing) == 1U);
  standing.held = 1;
  BOOST_TEST(tasks_for(Policy::self_scheduling, standing) == 0U);
}

BOOST_AUTO_TEST_CASE(without_costs_a_chunk_is_counted_in_tasks) {
  Standing standing = worker();
  standing.backlog = {.tasks = 1600, .remaining = 800};
  BOOST_TEST(tasks_for(Policy::guided, standing) == 100U);
  BOOST_TEST(tasks_for(Policy::factoring, standing) == 50U);
  // f = 100, 32 chunks, a step of 99 / 31; half is gone: sqrt(101.6^2 - 2 * 3.19 * 800) - 1.6 = 70.6.
  BOOST_TEST(tasks_for(Policy::trapezoid, standing) == 71U);
  standing.held = 1;
  for (const Policy policy : kAllPolicies) {
    if (is_chunked(policy)) BOOST_TEST(tasks_for(policy, standing) == 0U);
  }
}

BOOST_AUTO_TEST_CASE(with_costs_a_chunk_is_predicted_work) {
  Standing standing = worker();
  standing.backlog = {.tasks = 1600, .remaining = 1200, .tasks_s = 16, .remaining_s = 8, .next_s = 0.01};
  BOOST_TEST((share_to_assign(Policy::guided, standing) == Share{1200, 1.0}));
  BOOST_TEST((share_to_assign(Policy::factoring, standing) == Share{1200, 0.5}));
  // f = 16 / 16 = 1, a step of 1 / 32; half is gone: sqrt((1 + 1/64)^2 - 8 / 16) - 1/64.
  const Share trapezoid = share_to_assign(Policy::trapezoid, standing);
  BOOST_TEST(trapezoid.tasks == 1200U);
  BOOST_TEST(trapezoid.seconds.value() == 0.71341, boost::test_tools::tolerance(1e-4));
  standing.rank = kMasterRank;
  BOOST_TEST((share_to_assign(Policy::guided, standing) == Share{1, std::nullopt}));
}

BOOST_AUTO_TEST_CASE(a_worker_without_history_holds_two_tasks) {
  Standing standing = worker();
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 2U);
  standing.held = 1;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 1U);
  standing.held = 2;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 0U);
}

BOOST_AUTO_TEST_CASE(short_tasks_are_queued_for_a_millisecond_besides_the_one_in_hand) {
  BOOST_TEST(tasks_for(Policy::dynamic, worker_with_mean(10e-3)) == 2U);
  BOOST_TEST(tasks_for(Policy::dynamic, worker_with_mean(1e-3)) == 2U);
  BOOST_TEST(tasks_for(Policy::dynamic, worker_with_mean(0.5e-3)) == 3U);
  BOOST_TEST(tasks_for(Policy::dynamic, worker_with_mean(0.3e-3)) == 5U);
  BOOST_TEST(tasks_for(Policy::dynamic, worker_with_mean(0.1e-3)) == 11U);
}

BOOST_AUTO_TEST_CASE(no_worker_holds_more_than_sixteen) {
  BOOST_TEST(tasks_for(Policy::dynamic, worker_with_mean(1e-6)) == 16U);
  BOOST_TEST(tasks_for(Policy::dynamic, worker_with_mean(0)) == 16U);
}

BOOST_AUTO_TEST_CASE(near_the_end_nobody_holds_more_than_two) {
  Standing standing = worker_with_mean(1e-6);
  standing.backlog.remaining = 8 * 16 * 2;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 16U);
  standing.backlog.remaining = 8 * 2 * 5;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 5U);
  standing.backlog.remaining = 8 * 2 * 3 - 1;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 2U);
  standing.held = 2;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 0U);
}

BOOST_AUTO_TEST_CASE(at_the_end_a_worker_holds_one_long_task_unless_costs_made_the_last_ones_small) {
  Standing standing = worker_with_mean(0.13e-3);  // a slice and 8 messages take 0.124 ms
  standing.held = 1;
  standing.backlog.remaining = 32;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 1U);
  standing.backlog.remaining = 31;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 0U);
  standing.mean_task_s = 0.12e-3;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 1U);
  standing.mean_task_s = 0.13e-3;
  standing.backlog.tasks_s = 1;
  standing.backlog.next_s = 0.13e-3;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 1U);
  standing.backlog.tasks_s = 0;
  standing.round_trip_s = 1e-3;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 3U);
}

BOOST_AUTO_TEST_CASE(an_owner_holds_its_tasks_to_the_end) {
  Standing standing = worker_with_mean(0.3e-3);
  standing.backlog.remaining = 7;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 1U);
  BOOST_TEST(tasks_for(Policy::cyclic_rows, standing) == 5U);
}

BOOST_AUTO_TEST_CASE(the_shorter_of_prediction_and_experience_says_how_many_tasks_make_a_millisecond) {
  Standing standing = worker_with_mean(0.5e-3);
  standing.backlog.tasks_s = 10;
  standing.backlog.next_s = 0.1e-3;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 11U);
  standing.backlog.next_s = 5e-3;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 3U);
}

BOOST_AUTO_TEST_CASE(over_a_slow_wire_tasks_cover_the_way_to_rank_0) {
  Standing standing = worker_with_mean(5e-3);
  standing.round_trip_s = 10.2e-3;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 6U);  // twice 10.2 ms besides the one in hand
  standing.backlog.remaining = 8;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 4U);  // once
  standing.round_trip_s = 100e-3;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 4U);
}

BOOST_AUTO_TEST_CASE(waiting_for_a_busy_rank_0_is_no_slow_wire) {
  Standing standing = worker_with_mean(20e-6);
  standing.backlog.remaining = 8;
  standing.round_trip_s = 0.12e-3;  // a slice and 8 messages take 0.124 ms
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 2U);
  standing.round_trip_s = 0.13e-3;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 4U);
}

BOOST_AUTO_TEST_CASE(a_worker_that_holds_more_than_it_should_gets_nothing) {
  Standing standing = worker_with_mean(10e-3);
  standing.held = 16;
  BOOST_TEST(tasks_for(Policy::dynamic, standing) == 0U);
}

BOOST_AUTO_TEST_CASE(rank_0_holds_one_task) {
  for (const Policy policy : kAllPolicies) {
    BOOST_TEST_CONTEXT(name_of(policy)) {
      Standing standing = worker_with_mean(1e-6);
      standing.rank = kMasterRank;
      standing.prefetch = 7;
      BOOST_TEST(tasks_for(policy, standing) == 1U);
      standing.held = 1;
      BOOST_TEST(tasks_for(policy, standing) == 0U);
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_is_given_where_nothing_is_left) {
  for (const Policy policy : kAllPolicies) {
    BOOST_TEST_CONTEXT(name_of(policy)) {
      for (const std::uint32_t held : {0U, 1U, 5U}) {
        Standing standing = worker_with_mean(1e-6);
        standing.backlog.remaining = 0;
        standing.held = held;
        BOOST_TEST(tasks_for(policy, standing) == 0U);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(an_explicit_prefetch_is_what_a_worker_holds) {
  for (const Policy policy : {Policy::dynamic, Policy::cyclic_rows, Policy::self_scheduling}) {
    Standing standing = worker_with_mean(10e-3);
    standing.prefetch = 5;
    standing.held = 1;
    BOOST_TEST(tasks_for(policy, standing) == 4U);
    standing.held = 5;
    BOOST_TEST(tasks_for(policy, standing) == 0U);
  }
}

BOOST_AUTO_TEST_CASE(an_explicit_prefetch_brings_the_next_guided_run_early) {
  Standing standing = worker();
  standing.backlog.remaining = 80;
  standing.held = 2;
  BOOST_TEST(tasks_for(Policy::guided, standing) == 0U);
  standing.prefetch = 3;
  BOOST_TEST(tasks_for(Policy::guided, standing) == 10U);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
