// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/master.h"

#include <boost/test/unit_test.hpp>
#include <stdexcept>
#include <vector>

namespace tessera::scheduler {
namespace {

Plan plan_of(Policy policy, std::uint32_t tasks) {
  Plan plan;
  plan.policy = policy;
  plan.tasks = tasks;
  return plan;
}

// A master whose every answer is looked at.
struct Dialogue {
  Dialogue(Policy policy, std::uint32_t tasks, std::uint32_t ranks) : master(plan_of(policy, tasks), ranks) {}

  Verdict say(const Event& event) {
    actions.clear();
    return master.handle(event, actions);
  }

  RunList assigned() const {
    BOOST_REQUIRE_EQUAL(actions.size(), 1U);
    return std::get<Assign>(actions[0]).runs;
  }

  Master master;
  std::vector<Action> actions;
};

RunList one_run(std::uint32_t first, std::uint32_t count) {
  RunList runs;
  runs.push(TaskRun{TaskId{first}, count});
  return runs;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(master)

BOOST_AUTO_TEST_CASE(a_hello_is_answered_with_work) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  BOOST_TEST((dialogue.say(Hello{2}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned() == one_run(0, 2)));
  BOOST_TEST((dialogue.say(Hello{0}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned() == one_run(2, 1)));
  BOOST_TEST(dialogue.master.held_by(2) == 2U);
}

BOOST_AUTO_TEST_CASE(a_result_is_answered_with_more_work) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  dialogue.say(Hello{1});
  BOOST_TEST((dialogue.say(Result{1, TaskId{1}, 1.0}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned() == one_run(2, 1)));
}

BOOST_AUTO_TEST_CASE(short_tasks_are_noticed) {
  Dialogue dialogue(Policy::dynamic, 10000, 2);
  dialogue.say(Hello{1});
  dialogue.say(Result{1, TaskId{0}, 0.2e-3});
  BOOST_TEST((dialogue.assigned() == one_run(2, 5)));  // six held: 1 ms and the one in hand
}

BOOST_AUTO_TEST_CASE(recent_tasks_count_more_than_a_long_past) {
  Dialogue dialogue(Policy::dynamic, 10000, 2);
  dialogue.say(Hello{1});
  std::uint32_t task = 0;
  for (; task < 100; ++task) dialogue.say(Result{1, TaskId{task}, 10e-3});
  BOOST_TEST(dialogue.master.held_by(1) == 2U);
  for (; task < 200; ++task) dialogue.say(Result{1, TaskId{task}, 1e-6});
  BOOST_TEST(dialogue.master.held_by(1) == 16U);
  for (; task < 220; ++task) dialogue.say(Result{1, TaskId{task}, 10e-3});
  BOOST_TEST(dialogue.master.held_by(1) == 2U);
}

BOOST_AUTO_TEST_CASE(the_last_result_ends_it_all) {
  Dialogue dialogue(Policy::self_scheduling, 2, 4);
  for (const Rank rank : {1U, 2U, 0U}) dialogue.say(Hello{rank});
  dialogue.say(Result{2, TaskId{1}, 1});
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST(!dialogue.master.is_done());
  dialogue.say(Result{1, TaskId{0}, 1});
  BOOST_TEST(dialogue.master.is_done());
  BOOST_REQUIRE_EQUAL(dialogue.actions.size(), 3U);
  BOOST_TEST(std::get<Stop>(dialogue.actions[0]).rank == 1U);
  BOOST_TEST(std::get<Stop>(dialogue.actions[1]).rank == 2U);
  BOOST_TEST(std::holds_alternative<Done>(dialogue.actions[2]));
}

BOOST_AUTO_TEST_CASE(who_comes_after_the_end_is_sent_home_at_once) {
  Dialogue dialogue(Policy::self_scheduling, 1, 3);
  dialogue.say(Hello{1});
  dialogue.say(Result{1, TaskId{0}, 1});
  BOOST_TEST((dialogue.say(Hello{2}) == Verdict::accepted));
  BOOST_REQUIRE_EQUAL(dialogue.actions.size(), 1U);
  BOOST_TEST(std::get<Stop>(dialogue.actions[0]).rank == 2U);
  BOOST_TEST((dialogue.say(Hello{2}) == Verdict::duplicate));
  BOOST_TEST(dialogue.actions.empty());
}

BOOST_AUTO_TEST_CASE(a_plan_without_tasks_is_done_from_the_start) {
  Dialogue dialogue(Policy::dynamic, 0, 2);
  BOOST_TEST(dialogue.master.is_done());
  dialogue.say(Hello{1});
  BOOST_REQUIRE_EQUAL(dialogue.actions.size(), 1U);
  BOOST_TEST(std::get<Stop>(dialogue.actions[0]).rank == 1U);
  dialogue.say(Hello{0});
  BOOST_TEST(dialogue.actions.empty());
}

BOOST_AUTO_TEST_CASE(what_was_accepted_is_not_accepted_again) {
  Dialogue dialogue(Policy::dynamic, 3, 3);
  dialogue.say(Hello{1});
  dialogue.say(Hello{2});
  dialogue.say(Result{1, TaskId{0}, 1});
  for (const Rank rank : {1U, 2U}) {
    BOOST_TEST((dialogue.say(Result{rank, TaskId{0}, 1}) == Verdict::duplicate));
    BOOST_TEST(dialogue.actions.empty());
  }
  BOOST_TEST(dialogue.master.accepted() == 1U);
}

BOOST_AUTO_TEST_CASE(a_result_counts_only_from_the_rank_that_holds_the_task) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  dialogue.say(Hello{1});
  BOOST_TEST((dialogue.say(Result{2, TaskId{0}, 1}) == Verdict::unassigned));
  BOOST_TEST((dialogue.say(Result{1, TaskId{5}, 1}) == Verdict::unassigned));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST(dialogue.master.held_by(1) == 2U);
  BOOST_TEST(dialogue.master.accepted() == 0U);
}

BOOST_AUTO_TEST_CASE(unknown_ranks_and_tasks_are_told_apart) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  BOOST_TEST((dialogue.say(Hello{3}) == Verdict::unknown));
  BOOST_TEST((dialogue.say(Leave{0xffffffff}) == Verdict::unknown));
  BOOST_TEST((dialogue.say(Result{3, TaskId{0}, 1}) == Verdict::unknown));
  BOOST_TEST((dialogue.say(Result{0, TaskId{10}, 1}) == Verdict::unknown));
  BOOST_TEST(dialogue.actions.empty());
}

BOOST_AUTO_TEST_CASE(a_second_hello_changes_nothing) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  dialogue.say(Hello{1});
  BOOST_TEST((dialogue.say(Hello{1}) == Verdict::duplicate));
  BOOST_TEST(dialogue.actions.empty());
}

BOOST_AUTO_TEST_CASE(who_left_delivers_but_gets_nothing_until_it_comes_again) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  dialogue.say(Hello{1});
  BOOST_TEST((dialogue.say(Leave{1}) == Verdict::accepted));
  BOOST_TEST((dialogue.say(Leave{1}) == Verdict::duplicate));
  BOOST_TEST((dialogue.say(Result{1, TaskId{0}, 1}) == Verdict::accepted));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST((dialogue.say(Hello{1}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned() == one_run(2, 1)));
}

BOOST_AUTO_TEST_CASE(an_assignment_never_has_more_runs_than_the_wire_carries) {
  Plan plan = plan_of(Policy::dynamic, 200);
  for (std::uint32_t task = 0; task < plan.tasks; ++task) plan.costs.push_back(task % 2);  // no two neighbours
  plan.prefetch = 16;
  Master master(plan, 2);
  std::vector<Action> actions;
  master.handle(Hello{1}, actions);
  BOOST_TEST(std::get<Assign>(actions.at(0)).runs.tasks() == 3U);
  master.handle(Result{1, TaskId{1}, 1}, actions);
  BOOST_TEST(master.held_by(1) == 5U);
}

BOOST_AUTO_TEST_CASE(an_infeasible_plan_is_refused) {
  Plan plan = plan_of(Policy::dynamic, 5);
  plan.prefetch = 0;
  BOOST_CHECK_THROW(Master(plan, 2), std::invalid_argument);
  BOOST_CHECK_THROW(Master(plan_of(Policy::dynamic, 5), 0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
