// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/task_queue.h"

#include <boost/test/unit_test.hpp>
#include <vector>

namespace tessera::scheduler {
namespace {

Plan plan_of(Policy policy, std::uint32_t tasks, std::vector<double> costs = {}) {
  Plan plan;
  plan.policy = policy;
  plan.tasks = tasks;
  plan.costs = std::move(costs);
  return plan;
}

std::vector<std::uint32_t> take_all(TaskQueue& queue, Rank rank, std::uint32_t at_a_time) {
  std::vector<std::uint32_t> taken;
  while (queue.remaining(rank) > 0) {
    for (const TaskRun& run : queue.take(rank, {at_a_time, {}})) {
      for (std::uint32_t i = 0; i < run.count; ++i) taken.push_back(index_of(run.first) + i);
    }
  }
  return taken;
}

RunList one_task(std::uint32_t task) {
  RunList runs;
  runs.push(TaskId{task});
  return runs;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(task_queue)

BOOST_AUTO_TEST_CASE(shared_tasks_come_in_ascending_order_whoever_takes_them) {
  TaskQueue queue(plan_of(Policy::guided, 10), 4);
  BOOST_TEST((queue.take(2, {3, {}}) == [] {
    RunList runs;
    runs.push(TaskRun{TaskId{0}, 3});
    return runs;
  }()));
  BOOST_TEST(queue.remaining(1) == 7U);
  BOOST_TEST(take_all(queue, 1, 4) == (std::vector<std::uint32_t>{3, 4, 5, 6, 7, 8, 9}),
             boost::test_tools::per_element());
  BOOST_TEST(queue.remaining(2) == 0U);
  BOOST_TEST(queue.take(2, {1, {}}).empty());
}

BOOST_AUTO_TEST_CASE(owned_tasks_come_to_rank_i_mod_p) {
  for (const Policy policy : {Policy::static_bands, Policy::cyclic_rows}) {
    for (const std::uint32_t ranks : {1U, 2U, 3U, 7U, 20U}) {
      for (const std::uint32_t tasks : {0U, 1U, 6U, 7U, 8U, 19U}) {
        TaskQueue queue(plan_of(policy, tasks), ranks);
        for (Rank rank = 0; rank < ranks; ++rank) {
          std::vector<std::uint32_t> owned;
          for (std::uint32_t task = rank; task < tasks; task += ranks) owned.push_back(task);
          BOOST_TEST(queue.remaining(rank) == owned.size());
          BOOST_TEST(take_all(queue, rank, 5) == owned, boost::test_tools::per_element());
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(predicted_costs_bring_the_dearest_task_first_and_keep_equals_in_order) {
  for (const Policy policy : {Policy::dynamic, Policy::self_scheduling}) {
    TaskQueue queue(plan_of(policy, 6, {1, 5, 2, 5, 0, 2}), 3);
    BOOST_TEST(take_all(queue, 1, 2) == (std::vector<std::uint32_t>{1, 3, 2, 5, 0, 4}),
               boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(runs_of_tasks_keep_their_order_whatever_they_cost) {
  TaskQueue queue(plan_of(Policy::guided, 4, {1, 5, 2, 5}), 2);
  BOOST_TEST(take_all(queue, 0, 2) == (std::vector<std::uint32_t>{0, 1, 2, 3}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_take_ends_where_its_runs_are_used_up) {
  TaskQueue queue(plan_of(Policy::cyclic_rows, 100), 2);
  BOOST_TEST(queue.take(0, {50, {}}).tasks() == RunList::kCapacity);
  BOOST_TEST(queue.remaining(0) == 47U);
  TaskQueue shared(plan_of(Policy::dynamic, 100), 2);
  BOOST_TEST(shared.take(0, {50, {}}).tasks() == 50U);
}

BOOST_AUTO_TEST_CASE(a_share_in_seconds_ends_with_the_task_that_fills_it) {
  TaskQueue queue(plan_of(Policy::guided, 5, {4, 1, 2, 1, 3}), 2);
  const auto count = [&](std::uint32_t most, double seconds) { return queue.take(1, {most, seconds}).tasks(); };
  BOOST_TEST(count(5, 0.5) == 1U);  // 4: never nothing
  BOOST_TEST(count(5, 2.5) == 2U);  // 1, 2
  BOOST_TEST(count(5, 1.0) == 1U);  // 1: exactly
  BOOST_TEST(count(0, 1.0) == 0U);
  BOOST_TEST(count(5, 99.0) == 1U);  // 3: all there is
  TaskQueue without_costs(plan_of(Policy::guided, 5), 2);
  BOOST_TEST(without_costs.take(1, {3, 0.0}).tasks() == 3U);
}

BOOST_AUTO_TEST_CASE(the_backlog_says_what_is_left_of_what_there_was) {
  TaskQueue queue(plan_of(Policy::dynamic, 4, {1, 5, 2, 4}), 3);
  queue.take(1, {2, {}});
  const Backlog backlog = queue.backlog(2);
  BOOST_TEST(backlog.tasks == 4U);
  BOOST_TEST(backlog.remaining == 2U);
  BOOST_TEST(backlog.tasks_s == 12.0);
  BOOST_TEST(backlog.remaining_s == 3.0);
  BOOST_TEST(backlog.next_s == 2.0);
  queue.take(1, {2, {}});
  BOOST_TEST(queue.backlog(0).remaining_s == 0.0);
  BOOST_TEST(queue.backlog(0).next_s == 0.0);
}

BOOST_AUTO_TEST_CASE(the_backlog_of_an_owner_is_its_own) {
  TaskQueue queue(plan_of(Policy::cyclic_rows, 8, std::vector<double>(8, 1.0)), 3);
  queue.take(2, {1, {}});
  BOOST_TEST(queue.backlog(1).tasks == 3U);
  BOOST_TEST(queue.backlog(2).tasks == 2U);
  BOOST_TEST(queue.backlog(2).remaining == 1U);
  BOOST_TEST(queue.backlog(2).tasks_s == 0.0);
  TaskQueue few(plan_of(Policy::static_bands, 2), 3);
  BOOST_TEST(few.backlog(2).tasks == 0U);
}

BOOST_AUTO_TEST_CASE(what_was_put_back_comes_before_all_others_in_the_order_of_its_return) {
  TaskQueue queue(plan_of(Policy::dynamic, 10), 3);
  queue.take(1, {6, {}});
  BOOST_TEST(!queue.has_returned());
  queue.put_back(TaskId{4});
  queue.put_back(TaskId{1});
  BOOST_TEST(queue.has_returned());
  BOOST_TEST(queue.remaining(2) == 6U);
  BOOST_TEST((queue.take(2, {1, {}}) == one_task(4)));
  BOOST_TEST(queue.has_returned());
  BOOST_TEST(take_all(queue, 2, 2) == (std::vector<std::uint32_t>{1, 6, 7, 8, 9}), boost::test_tools::per_element());
  BOOST_TEST(!queue.has_returned());
}

BOOST_AUTO_TEST_CASE(what_was_put_back_comes_before_dearer_tasks) {
  TaskQueue queue(plan_of(Policy::dynamic, 4, {1, 9, 2, 8}), 2);
  BOOST_TEST((queue.take(1, {1, {}}) == one_task(1)));
  queue.take(1, {2, {}});
  queue.put_back(TaskId{2});
  BOOST_TEST(take_all(queue, 1, 1) == (std::vector<std::uint32_t>{2, 0}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_an_owner_put_back_comes_to_whoever_asks) {
  TaskQueue queue(plan_of(Policy::cyclic_rows, 8), 2);
  queue.take(1, {2, {}});
  queue.put_back(TaskId{1});
  BOOST_TEST(queue.remaining(0) == 5U);
  BOOST_TEST(queue.remaining(1) == 3U);
  BOOST_TEST((queue.take(0, {1, {}}) == one_task(1)));
  BOOST_TEST(queue.remaining(1) == 2U);
  BOOST_TEST(take_all(queue, 1, 1) == (std::vector<std::uint32_t>{5, 7}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_an_owner_has_not_had_can_be_made_everybodys) {
  TaskQueue queue(plan_of(Policy::cyclic_rows, 8), 3);
  queue.take(1, {1, {}});
  queue.put_back(TaskId{1});
  queue.disown(1);
  BOOST_TEST(queue.remaining(2) == 5U);
  BOOST_TEST(take_all(queue, 2, 1) == (std::vector<std::uint32_t>{1, 4, 7, 2, 5}), boost::test_tools::per_element());
  BOOST_TEST(queue.remaining(1) == 0U);
  queue.disown(1);
  BOOST_TEST(!queue.has_returned());
  BOOST_TEST(queue.remaining(0) == 3U);

  // What nobody owns stays as it is
  TaskQueue shared(plan_of(Policy::dynamic, 8), 3);
  shared.disown(1);
  BOOST_TEST(!shared.has_returned());
  BOOST_TEST(shared.remaining(1) == 8U);
}

BOOST_AUTO_TEST_CASE(a_task_can_be_put_back_again_and_again) {
  TaskQueue queue(plan_of(Policy::self_scheduling, 1), 2);
  queue.take(1, {1, {}});
  for (int times = 0; times < 3; ++times) {
    queue.put_back(TaskId{0});
    BOOST_TEST((queue.take(1, {5, {}}) == one_task(0)));
    BOOST_TEST(queue.remaining(1) == 0U);
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_into_a_list_stays_in_its_place) {
  TaskQueue queue(plan_of(Policy::dynamic, 20), 2);
  queue.take(1, {12, {}});
  for (const std::uint32_t task : {1U, 3U, 5U, 7U}) queue.put_back(TaskId{task});
  BOOST_TEST(queue.take(1, {10, {}}).tasks() == RunList::kCapacity);
  BOOST_TEST(queue.remaining(1) == 9U);
  BOOST_TEST((queue.take(1, {1, {}}) == one_task(7)));
}

BOOST_AUTO_TEST_CASE(what_is_done_after_all_is_withdrawn) {
  TaskQueue queue(plan_of(Policy::dynamic, 6), 2);
  queue.take(1, {4, {}});
  for (const std::uint32_t task : {3U, 0U, 2U}) queue.put_back(TaskId{task});
  queue.withdraw(TaskId{0});
  BOOST_TEST(queue.remaining(1) == 4U);
  queue.withdraw(TaskId{0});  // no longer here
  queue.withdraw(TaskId{5});  // never put back: it is still to come
  BOOST_TEST(take_all(queue, 1, 1) == (std::vector<std::uint32_t>{3, 2, 4, 5}), boost::test_tools::per_element());
  queue.put_back(TaskId{1});
  queue.withdraw(TaskId{1});
  BOOST_TEST(!queue.has_returned());
  BOOST_TEST(queue.take(1, {1, {}}).empty());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
