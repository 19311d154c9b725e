// SPDX-License-Identifier: BSD-3-Clause
// How work is handed out, taken back and asked for while nothing goes wrong. Faults and the end have files of their
// own.
#include "scheduler/master.h"

#include <boost/test/unit_test.hpp>
#include <stdexcept>
#include <vector>

#include "scheduler/all_policies.h"
#include "scheduler/dialogue.h"

namespace tessera::scheduler {
namespace {

std::uint32_t first_of(const RunList& runs) {
  return index_of(runs.begin()->first);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(master)

BOOST_AUTO_TEST_CASE(workers_have_their_first_tasks_without_a_word) {
  const Dialogue dialogue(Policy::dynamic, 10, 3);
  BOOST_TEST((first_tasks(plan_of(Policy::dynamic, 10), 3)[1] == one_run(0, 2)));
  BOOST_TEST((first_tasks(plan_of(Policy::dynamic, 10), 3)[2] == one_run(2, 2)));
  BOOST_TEST(dialogue.master.held_by(0) == 0U);
  BOOST_TEST(dialogue.master.held_by(1) == 2U);
  BOOST_TEST(dialogue.master.held_by(2) == 2U);
}

BOOST_AUTO_TEST_CASE(what_a_worker_begins_with_is_what_the_master_counts_on) {
  for (const Policy policy : kAllPolicies) {
    for (const std::uint32_t ranks : {2U, 3U, 8U}) {
      for (const std::uint32_t tasks : {0U, 1U, 7U, 100U}) {
        Plan plan = plan_of(policy, tasks);
        for (std::uint32_t task = 0; task < tasks; ++task) plan.costs.push_back(task * 7 % 5);
        Dialogue dialogue(plan, ranks);
        std::vector<int> times(tasks, 0);
        for (Rank rank = 1; rank < ranks; ++rank) {
          const RunList first = first_tasks(plan, ranks)[rank];
          BOOST_TEST(dialogue.master.held_by(rank) == first.tasks());
          for (const TaskRun& run : first) {
            for (std::uint32_t i = 0; i < run.count; ++i) {
              const TaskId task{index_of(run.first) + i};
              BOOST_TEST(++times.at(index_of(task)) == 1);
              BOOST_TEST((dialogue.say(Result{rank, task, 1}) == Verdict::accepted));
            }
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_hello_is_taken_down_once) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  BOOST_TEST((dialogue.say(Hello{2}) == Verdict::accepted));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST((dialogue.say(Hello{2}) == Verdict::duplicate));
  BOOST_TEST(dialogue.actions.empty());
}

BOOST_AUTO_TEST_CASE(a_rank_whose_results_are_long_on_the_way_holds_more) {
  Dialogue near(Policy::dynamic, 1000, 2);
  near.now_s = 5e-3;
  near.say(Result{.rank = 1, .task = TaskId{0}, .busy_s = 5e-3, .start_s = 0});
  BOOST_TEST(near.assigned_to(1).tasks() == 1U);
  near.now_s = 40e-3;  // one that was late says nothing of the way
  near.say(Result{.rank = 1, .task = TaskId{1}, .busy_s = 5e-3, .start_s = 5e-3});
  BOOST_TEST(near.assigned_to(1).tasks() == 1U);
  Dialogue far(Policy::dynamic, 1000, 2);
  far.now_s = 10e-3;
  far.say(Result{.rank = 1, .task = TaskId{0}, .busy_s = 5e-3, .start_s = 0});
  BOOST_TEST(far.assigned_to(1).tasks() == 4U);
}

BOOST_AUTO_TEST_CASE(a_result_is_answered_with_more_work) {
  Dialogue dialogue(Policy::dynamic, 20, 3);
  BOOST_TEST((dialogue.say(Result{1, TaskId{1}, 1.0}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(1) == one_run(4, 1)));
  BOOST_TEST(dialogue.master.accepted() == 1U);
}

BOOST_AUTO_TEST_CASE(a_result_may_come_before_the_hello) {
  Dialogue dialogue(Policy::dynamic, 10, 2);
  BOOST_TEST((dialogue.say(Result{1, TaskId{0}, 1.0}) == Verdict::accepted));
  BOOST_TEST((dialogue.say(Hello{1}) == Verdict::accepted));
}

BOOST_AUTO_TEST_CASE(rank_0_renders_while_it_has_its_seat) {
  Dialogue dialogue(Policy::dynamic, 10, 2);
  BOOST_TEST((dialogue.say(LeaveSeat{}) == Verdict::duplicate));
  BOOST_TEST((dialogue.say(TakeSeat{}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(0) == one_run(2, 1)));
  BOOST_TEST((dialogue.say(TakeSeat{}) == Verdict::duplicate));
  BOOST_TEST((dialogue.say(Result{0, TaskId{2}, 1}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(0) == one_run(3, 1)));
  BOOST_TEST((dialogue.say(LeaveSeat{}) == Verdict::accepted));
  BOOST_TEST((dialogue.say(Result{0, TaskId{3}, 1}) == Verdict::accepted));  // what it holds, it still delivers
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST((dialogue.say(TakeSeat{}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(0) == one_run(4, 1)));
}

BOOST_AUTO_TEST_CASE(short_tasks_are_noticed) {
  Dialogue dialogue(Policy::dynamic, 10000, 2);
  dialogue.say(Result{1, TaskId{0}, 0.2e-3});
  BOOST_TEST((dialogue.assigned_to(1) == one_run(2, 5)));  // six held: 1 ms and the one in hand
}

BOOST_AUTO_TEST_CASE(recent_tasks_count_more_than_a_long_past) {
  Dialogue dialogue(Policy::dynamic, 10000, 2);
  std::uint32_t task = 0;
  for (; task < 100; ++task) dialogue.say(Result{1, TaskId{task}, 10e-3});
  BOOST_TEST(dialogue.master.held_by(1) == 2U);
  for (; task < 200; ++task) dialogue.say(Result{1, TaskId{task}, 1e-6});
  BOOST_TEST(dialogue.master.held_by(1) == 16U);
  for (; task < 220; ++task) dialogue.say(Result{1, TaskId{task}, 10e-3});
  BOOST_TEST(dialogue.master.held_by(1) == 2U);
}

BOOST_AUTO_TEST_CASE(what_was_accepted_is_not_accepted_again) {
  Dialogue dialogue(Policy::dynamic, 30, 3);
  dialogue.say(Result{1, TaskId{0}, 1});
  for (const Rank rank : {1U, 2U}) {
    BOOST_TEST((dialogue.say(Result{rank, TaskId{0}, 1}) == Verdict::duplicate));
    BOOST_TEST(dialogue.actions.empty());
  }
  BOOST_TEST(dialogue.master.accepted() == 1U);
}

BOOST_AUTO_TEST_CASE(a_result_counts_only_from_a_rank_that_has_the_task) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  BOOST_TEST((dialogue.say(Result{2, TaskId{0}, 1}) == Verdict::unassigned));
  BOOST_TEST((dialogue.say(Result{1, TaskId{5}, 1}) == Verdict::unassigned));
  BOOST_TEST((dialogue.say(Result{0, TaskId{0}, 1}) == Verdict::unassigned));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST(dialogue.master.held_by(1) == 2U);
  BOOST_TEST(dialogue.master.accepted() == 0U);
}

BOOST_AUTO_TEST_CASE(unknown_ranks_and_tasks_are_told_apart) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  for (const Rank rank : {3U, 0xffffffffU}) {
    for (const Event& event : std::vector<Event>{Hello{rank}, Result{rank, TaskId{0}, 1}, Returned{rank, {}},
                                                 Damaged{rank, TaskId{0}}, Alive{rank}, Bye{rank}}) {
      BOOST_TEST((dialogue.say(event) == Verdict::unknown));
    }
  }
  // Rank 0 is no worker
  for (const Event& event :
       std::vector<Event>{Hello{0}, Returned{0, one_run(0, 1)}, Damaged{0, TaskId{0}}, Alive{0}, Bye{0}}) {
    BOOST_TEST((dialogue.say(event) == Verdict::unknown));
  }
  BOOST_TEST((dialogue.say(Result{1, TaskId{10}, 1}) == Verdict::unknown));
  BOOST_TEST((dialogue.say(Returned{1, one_run(9, 2)}) != Verdict::accepted));
  BOOST_TEST((dialogue.say(Returned{1, one_run(10, 1)}) == Verdict::unknown));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST((dialogue.master.faults() == Faults{}));
}

BOOST_AUTO_TEST_CASE(an_idle_rank_makes_the_busiest_one_give_back) {
  Plan plan = plan_of(Policy::dynamic, 8);
  plan.prefetch = 4;
  Dialogue dialogue(plan, 3);  // ranks 1 and 2 have all tasks, four each
  BOOST_TEST((dialogue.say(Result{1, TaskId{0}, 1}) == Verdict::accepted));
  BOOST_TEST((dialogue.say(Result{2, TaskId{4}, 5}) == Verdict::accepted));
  BOOST_TEST(dialogue.actions.empty());

  // Rank 0 finds nothing: of rank 2, whose tasks take longer, half is asked back
  dialogue.say(TakeSeat{});
  BOOST_REQUIRE_EQUAL(dialogue.actions.size(), 1U);
  const AskBack asked = std::get<AskBack>(dialogue.actions[0]);
  BOOST_TEST(asked.rank == 2U);
  BOOST_TEST(asked.tasks == 1U);

  BOOST_TEST((dialogue.say(Returned{2, one_run(7, 1)}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(0) == one_run(7, 1)));
  BOOST_TEST(dialogue.master.held_by(2) == 2U);
  BOOST_TEST(dialogue.master.faults().returned == 1U);
  BOOST_TEST((dialogue.say(Result{2, TaskId{7}, 1}) == Verdict::unassigned));
  BOOST_TEST((dialogue.say(Result{0, TaskId{7}, 1}) == Verdict::accepted));
}

BOOST_AUTO_TEST_CASE(a_rank_is_asked_again_only_when_it_has_answered) {
  Plan plan = plan_of(Policy::dynamic, 4);
  plan.prefetch = 4;
  Dialogue dialogue(plan, 4);  // rank 1 has all
  dialogue.say(TakeSeat{});
  BOOST_TEST(dialogue.count<AskBack>(dialogue.actions) == 1U);
  dialogue.say(LeaveSeat{});
  dialogue.say(TakeSeat{});
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST((dialogue.say(Returned{1, {}}) == Verdict::accepted));
  dialogue.say(LeaveSeat{});
  dialogue.say(TakeSeat{});
  BOOST_TEST(dialogue.count<AskBack>(dialogue.actions) == 1U);
}

BOOST_AUTO_TEST_CASE(what_is_not_worth_asking_for_is_left) {
  const auto asks = [](const Plan& plan, double busy_s) {
    Dialogue dialogue(plan, 2);
    dialogue.say(Result{1, TaskId{0}, busy_s});
    dialogue.say(TakeSeat{});
    return dialogue.count<AskBack>(dialogue.actions) == 1;
  };
  Plan plan = plan_of(Policy::dynamic, 3);
  plan.prefetch = 3;
  BOOST_TEST(asks(plan, 1));
  BOOST_TEST(!asks(plan, 1e-6));  // a worker will have begun it before the question is there
  Plan silent = plan;
  silent.ask_back = false;
  BOOST_TEST(!asks(silent, 1));
  Plan guided = plan;
  guided.policy = Policy::guided;
  BOOST_TEST(!asks(guided, 1));
  Plan last = plan_of(Policy::dynamic, 2);
  last.prefetch = 2;
  BOOST_TEST(!asks(last, 1));  // the one that is left is in hand
}

BOOST_AUTO_TEST_CASE(who_gave_everything_back_gets_work_again) {
  Dialogue dialogue(Policy::dynamic, 10, 2);
  BOOST_TEST((dialogue.say(Returned{1, one_run(0, 2)}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(1) == one_run(0, 2)));  // before all others
}

BOOST_AUTO_TEST_CASE(nothing_of_a_return_counts_where_a_part_of_it_is_wrong) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  RunList runs = one_run(0, 2);
  runs.push(TaskRun{TaskId{2}, 1});  // that is with rank 2
  BOOST_TEST((dialogue.say(Returned{1, runs}) == Verdict::unassigned));
  BOOST_TEST((dialogue.say(Returned{1, one_run(0, 0xffffffff)}) != Verdict::accepted));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST(dialogue.master.held_by(1) == 2U);
  BOOST_TEST(dialogue.master.faults().returned == 0U);
  BOOST_TEST((dialogue.say(Result{1, TaskId{0}, 1}) == Verdict::accepted));
}

BOOST_AUTO_TEST_CASE(the_same_task_cannot_be_returned_twice) {
  Dialogue dialogue(Policy::dynamic, 10, 3);
  RunList overlapping = one_run(0, 2);
  overlapping.push(TaskRun{TaskId{1}, 1});
  BOOST_TEST((dialogue.say(Returned{1, overlapping}) == Verdict::unassigned));
  BOOST_TEST(dialogue.master.held_by(1) == 2U);
  BOOST_TEST((dialogue.say(Returned{1, one_run(1, 1)}) == Verdict::accepted));
  BOOST_TEST((dialogue.say(Returned{1, one_run(1, 1)}) == Verdict::unassigned));
  BOOST_TEST(dialogue.master.held_by(1) == 1U);
}

BOOST_AUTO_TEST_CASE(owned_tasks_go_to_their_owner_alone) {
  Dialogue dialogue(Policy::cyclic_rows, 9, 3);
  BOOST_TEST((dialogue.say(Result{2, TaskId{2}, 1}) == Verdict::accepted));
  for (const Action& action : dialogue.actions) BOOST_TEST(first_of(std::get<Assign>(action).runs) % 3 == 2U);
  dialogue.say(TakeSeat{});
  BOOST_TEST((dialogue.assigned_to(0) == one_run(0, 1)));
}

BOOST_AUTO_TEST_CASE(an_assignment_never_has_more_runs_than_the_wire_carries) {
  Plan plan = plan_of(Policy::dynamic, 200);
  for (std::uint32_t task = 0; task < plan.tasks; ++task) plan.costs.push_back(task % 2);  // no two neighbours
  plan.prefetch = 16;
  Dialogue dialogue(plan, 2);
  BOOST_TEST(dialogue.master.held_by(1) == 3U);
  dialogue.say(Result{1, TaskId{1}, 1});
  BOOST_TEST(dialogue.master.held_by(1) == 5U);
}

BOOST_AUTO_TEST_CASE(an_infeasible_plan_is_refused) {
  Plan plan = plan_of(Policy::dynamic, 5);
  plan.prefetch = 0;
  BOOST_CHECK_THROW(Master(plan, 2), std::invalid_argument);
  BOOST_CHECK_THROW(Master(plan_of(Policy::dynamic, 5), 0), std::invalid_argument);
  for (const double lease_s : {0.0, -1.0}) {
    Plan hasty = plan_of(Policy::dynamic, 5);
    hasty.lease_s = lease_s;
    BOOST_CHECK_THROW(Master(hasty, 2), std::invalid_argument);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
