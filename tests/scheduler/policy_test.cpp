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
  return {.rank = 3, .ranks = 8, .remaining = 100000, .held = 0, .mean_task_s = {}, .prefetch = {}};
}

Standing worker_with_mean(double seconds) {
  Standing standing = worker();
  standing.mean_task_s = seconds;
  return standing;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(policy)

BOOST_AUTO_TEST_CASE(every_name_leads_back_to_its_policy) {
  const std::vector<std::string> names{"dynamic", "static-bands", "cyclic-rows", "self", "guided"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    BOOST_TEST(name_of(kAllPolicies[i]) == names[i]);
    BOOST_TEST((parse_policy(names[i]) == kAllPolicies[i]));
  }
}

BOOST_AUTO_TEST_CASE(other_names_are_no_policies) {
  for (const char* name : {"", "Dynamic", "self ", "static_bands", "factoring"}) BOOST_TEST(!parse_policy(name));
}

BOOST_AUTO_TEST_CASE(only_bands_and_rows_have_owners) {
  BOOST_TEST(has_owners(Policy::static_bands));
  BOOST_TEST(has_owners(Policy::cyclic_rows));
  BOOST_TEST(!has_owners(Policy::dynamic));
  BOOST_TEST(!has_owners(Policy::self_scheduling));
  BOOST_TEST(!has_owners(Policy::guided));
}

BOOST_AUTO_TEST_CASE(self_scheduling_gives_one_task_to_a_rank_that_has_none) {
  Standing standing = worker_with_mean(1e-6);
  BOOST_TEST(tasks_to_assign(Policy::self_scheduling, standing) == 1U);
  standing.held = 1;
  BOOST_TEST(tasks_to_assign(Policy::self_scheduling, standing) == 0U);
}

BOOST_AUTO_TEST_CASE(guided_chunks_are_the_published_ones) {
  // Polychronopoulos and Kuck's example: 100 iterations on 5 processors.
  const std::vector<std::uint32_t> published{20, 16, 13, 11, 8, 7, 5, 4, 4, 3, 2, 2, 1, 1, 1, 1, 1};
  Standing standing{.rank = 1, .ranks = 5, .remaining = 100, .held = 0, .mean_task_s = {}, .prefetch = {}};
  for (const std::uint32_t chunk : published) {
    BOOST_TEST(tasks_to_assign(Policy::guided, standing) == chunk);
    standing.remaining -= chunk;
  }
  BOOST_TEST(standing.remaining == 0U);
}

BOOST_AUTO_TEST_CASE(a_worker_without_history_holds_two_tasks) {
  Standing standing = worker();
  BOOST_TEST(tasks_to_assign(Policy::dynamic, standing) == 2U);
  standing.held = 1;
  BOOST_TEST(tasks_to_assign(Policy::dynamic, standing) == 1U);
  standing.held = 2;
  BOOST_TEST(tasks_to_assign(Policy::dynamic, standing) == 0U);
}

BOOST_AUTO_TEST_CASE(short_tasks_are_queued_for_a_millisecond_besides_the_one_in_hand) {
  BOOST_TEST(tasks_to_assign(Policy::dynamic, worker_with_mean(10e-3)) == 2U);
  BOOST_TEST(tasks_to_assign(Policy::dynamic, worker_with_mean(1e-3)) == 2U);
  BOOST_TEST(tasks_to_assign(Policy::dynamic, worker_with_mean(0.5e-3)) == 3U);
  BOOST_TEST(tasks_to_assign(Policy::dynamic, worker_with_mean(0.3e-3)) == 5U);
  BOOST_TEST(tasks_to_assign(Policy::dynamic, worker_with_mean(0.1e-3)) == 11U);
}

BOOST_AUTO_TEST_CASE(no_worker_holds_more_than_sixteen) {
  BOOST_TEST(tasks_to_assign(Policy::dynamic, worker_with_mean(1e-6)) == 16U);
  BOOST_TEST(tasks_to_assign(Policy::dynamic, worker_with_mean(0)) == 16U);
}

BOOST_AUTO_TEST_CASE(near_the_end_nobody_holds_more_than_two) {
  Standing standing = worker_with_mean(1e-6);
  standing.remaining = 8 * 16 * 2;
  BOOST_TEST(tasks_to_assign(Policy::dynamic, standing) == 16U);
  standing.remaining = 8 * 2 * 5;
  BOOST_TEST(tasks_to_assign(Policy::dynamic, standing) == 5U);
  standing.remaining = 8 * 2 * 3 - 1;
  BOOST_TEST(tasks_to_assign(Policy::dynamic, standing) == 2U);
  standing.held = 2;
  BOOST_TEST(tasks_to_assign(Policy::dynamic, standing) == 0U);
}

BOOST_AUTO_TEST_CASE(a_worker_that_holds_more_than_it_should_gets_nothing) {
  Standing standing = worker_with_mean(10e-3);
  standing.held = 16;
  BOOST_TEST(tasks_to_assign(Policy::dynamic, standing) == 0U);
}

BOOST_AUTO_TEST_CASE(rank_0_holds_one_task) {
  for (const Policy policy : kAllPolicies) {
    BOOST_TEST_CONTEXT(name_of(policy)) {
      Standing standing = worker_with_mean(1e-6);
      standing.rank = kMasterRank;
      standing.prefetch = 7;
      BOOST_TEST(tasks_to_assign(policy, standing) == 1U);
      standing.held = 1;
      BOOST_TEST(tasks_to_assign(policy, standing) == 0U);
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_is_given_where_nothing_is_left) {
  for (const Policy policy : kAllPolicies) {
    BOOST_TEST_CONTEXT(name_of(policy)) {
      for (const std::uint32_t held : {0U, 1U, 5U}) {
        Standing standing = worker_with_mean(1e-6);
        standing.remaining = 0;
        standing.held = held;
        BOOST_TEST(tasks_to_assign(policy, standing) == 0U);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(an_explicit_prefetch_is_what_a_worker_holds) {
  for (const Policy policy : {Policy::dynamic, Policy::cyclic_rows, Policy::self_scheduling}) {
    Standing standing = worker_with_mean(10e-3);
    standing.prefetch = 5;
    standing.held = 1;
    BOOST_TEST(tasks_to_assign(policy, standing) == 4U);
    standing.held = 5;
    BOOST_TEST(tasks_to_assign(policy, standing) == 0U);
  }
}

BOOST_AUTO_TEST_CASE(an_explicit_prefetch_brings_the_next_guided_run_early) {
  Standing standing = worker();
  standing.remaining = 80;
  standing.held = 2;
  BOOST_TEST(tasks_to_assign(Policy::guided, standing) == 0U);
  standing.prefetch = 3;
  BOOST_TEST(tasks_to_assign(Policy::guided, standing) == 10U);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
