// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/metrics.h"

#include <boost/test/unit_test.hpp>

namespace tessera::scheduler {
namespace {

constexpr double kTight = 1e-12;

// Rank 0: 0-2 and 2-3, rank 1: 0-4, rank 2: 0-1; the last result is accepted at 5.
RunRecord three_ranks() {
  RunRecord run;
  run.makespan_s = 5;
  run.tasks = {{TaskId{0}, 0, 0, 2, 10}, {TaskId{1}, 1, 0, 4, 10}, {TaskId{2}, 2, 0, 1, 10}, {TaskId{3}, 0, 2, 3, 10}};
  run.ranks = {{0, "a", 2, 3, 2}, {1, "a", 1, 4, 1}, {2, "b", 1, 1, 4}};
  return run;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(balance)

BOOST_AUTO_TEST_CASE(three_ranks_give_the_values_computed_by_hand) {
  const Balance balance = balance_of(three_ranks());
  BOOST_CHECK_CLOSE(balance.imbalance, 4.0 / (8.0 / 3) - 1, kTight);
  BOOST_CHECK_CLOSE(balance.load_balance, (8.0 / 3) / 4.0, kTight);
  BOOST_CHECK_CLOSE(balance.efficiency, 8.0 / 15, kTight);
  BOOST_CHECK_CLOSE(balance.tail_s, 4.0, kTight);  // rank 2 is idle from 1 on
  BOOST_CHECK_CLOSE(balance.graham_bound_s, 8.0 / 3 + 2.0 / 3 * 4, kTight);
  BOOST_TEST(balance.makespan_s == 5.0);
}

BOOST_AUTO_TEST_CASE(one_busy_rank_is_in_perfect_balance) {
  RunRecord run;
  run.makespan_s = 2;
  run.tasks = {{TaskId{0}, 0, 0, 2, 0}};
  run.ranks = {{0, "a", 1, 2, 0}};
  const Balance balance = balance_of(run);
  BOOST_TEST(balance.imbalance == 0.0);
  BOOST_TEST(balance.load_balance == 1.0);
  BOOST_TEST(balance.efficiency == 1.0);
  BOOST_TEST(balance.tail_s == 0.0);
  BOOST_TEST(balance.graham_bound_s == 2.0);
}

BOOST_AUTO_TEST_CASE(a_master_that_only_served_counts_but_has_no_tail) {
  RunRecord run;
  run.makespan_s = 4;
  run.tasks = {{TaskId{0}, 1, 0, 3, 0}};
  run.ranks = {{0, "a", 0, 0, 4}, {1, "a", 1, 3, 1}};
  const Balance balance = balance_of(run);
  BOOST_CHECK_CLOSE(balance.efficiency, 3.0 / 8, kTight);
  BOOST_CHECK_CLOSE(balance.imbalance, 1.0, kTight);
  BOOST_CHECK_CLOSE(balance.tail_s, 1.0, kTight);
}

BOOST_AUTO_TEST_CASE(a_worker_that_got_nothing_was_idle_from_the_start) {
  RunRecord run = three_ranks();
  run.ranks.push_back({3, "b", 0, 0, 5});
  BOOST_CHECK_CLOSE(balance_of(run).tail_s, 5.0, kTight);
}

BOOST_AUTO_TEST_CASE(the_tail_is_measured_on_rank_0s_clock) {
  RunRecord run = three_ranks();
  run.ranks[2].clock_offset_s = 0.5;
  BOOST_CHECK_CLOSE(balance_of(run).tail_s, 3.5, kTight);
}

BOOST_AUTO_TEST_CASE(nothing_done_gives_zeros) {
  const Balance none = balance_of(RunRecord{});
  BOOST_TEST(none.imbalance == 0.0);
  BOOST_TEST(none.efficiency == 0.0);
  BOOST_TEST(none.graham_bound_s == 0.0);

  RunRecord idle;
  idle.ranks = {{0, "a", 0, 0, 0}, {1, "a", 0, 0, 0}};
  const Balance balance = balance_of(idle);
  BOOST_TEST(balance.imbalance == 0.0);
  BOOST_TEST(balance.load_balance == 0.0);
  BOOST_TEST(balance.efficiency == 0.0);
  BOOST_TEST(balance.tail_s == 0.0);
  BOOST_TEST(balance.graham_bound_s == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(overhead)

// Two workers: one has two tasks from 0 to 2, one of them until 3, and one more from 5 to 6; the other has one from 1
// to 5, and the next from the moment in which the first came back. Rank 0 did a task of its own.
BOOST_AUTO_TEST_CASE(workers_that_hold_tasks_give_the_values_computed_by_hand) {
  RunRecord run;
  run.ranks.resize(3);
  run.messages = {20, 1000};
  const auto add = [&](Rank rank, double assigned_s, double received_s, double accepted_s) {
    TaskRecord task;
    task.rank = rank;
    task.assigned_s = assigned_s;
    task.received_s = received_s;
    task.accepted_s = accepted_s;
    run.tasks.push_back(task);
  };
  add(1, 0, 3, 3.5);
  add(1, 0, 2, 2.5);
  add(1, 5, 6, 6.25);
  add(2, 5, 6, 6.5);
  add(2, 1, 5, 5.25);
  add(0, 0, 9, 19);
  add(0, 0, 9, 19);
  add(0, 0, 9, 19);
  const Overhead overhead = overhead_of(run);
  BOOST_TEST(overhead.messages_per_task == 2.5);
  BOOST_TEST(overhead.bytes_per_task == 125.0);
  BOOST_CHECK_CLOSE(overhead.master_s_per_task, 2.0 / 5, kTight);
  BOOST_TEST(overhead.most_held == 2U);
  BOOST_CHECK_CLOSE(overhead.mean_held, (3 + 2 + 1 + 4 + 1) / (3.0 + 1 + 5), kTight);
}

BOOST_AUTO_TEST_CASE(rank_0_alone_has_none) {
  RunRecord run;
  run.ranks.resize(1);
  run.tasks.resize(3);
  for (const RunRecord& each : {run, RunRecord{}}) {
    const Overhead overhead = overhead_of(each);
    BOOST_TEST(overhead.messages_per_task == 0.0);
    BOOST_TEST(overhead.bytes_per_task == 0.0);
    BOOST_TEST(overhead.master_s_per_task == 0.0);
    BOOST_TEST(overhead.most_held == 0U);
    BOOST_TEST(overhead.mean_held == 0.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
