// SPDX-License-Identifier: BSD-3-Clause
// How a master comes to its end: the last result, goodbyes, ranks that are given up, and plans that have no tasks.
#include <boost/test/unit_test.hpp>
#include <limits>
#include <vector>

#include "scheduler/dialogue.h"

namespace tessera::scheduler {
namespace {

// Everything is done by rank 1, and both workers have their Stop.
Dialogue finished() {
  Dialogue dialogue(Policy::self_scheduling, 2, 3);
  dialogue.say(Result{1, TaskId{0}, 1});
  dialogue.say(Result{2, TaskId{1}, 1});
  return dialogue;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(master_end)

BOOST_AUTO_TEST_CASE(the_last_result_ends_it_all) {
  Dialogue dialogue(Policy::self_scheduling, 2, 4);
  dialogue.say(Hello{2});
  dialogue.say(TakeSeat{});
  BOOST_TEST((dialogue.say(Result{2, TaskId{1}, 1}) == Verdict::accepted));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST(!dialogue.master.is_done());
  BOOST_TEST((dialogue.say(Result{1, TaskId{0}, 1}) == Verdict::accepted));
  BOOST_TEST(dialogue.master.is_done());
  BOOST_REQUIRE_EQUAL(dialogue.actions.size(), 4U);
  for (const Rank rank : {1U, 2U, 3U}) BOOST_TEST(std::get<Stop>(dialogue.actions[rank - 1]).rank == rank);
  BOOST_TEST(std::holds_alternative<Done>(dialogue.actions[3]));
}

BOOST_AUTO_TEST_CASE(it_is_over_when_the_last_worker_said_goodbye) {
  Dialogue dialogue = finished();
  BOOST_TEST(!dialogue.master.is_over());
  BOOST_TEST((dialogue.say(Bye{2}) == Verdict::accepted));
  BOOST_TEST(!dialogue.master.is_over());
  BOOST_TEST((dialogue.say(Bye{1}) == Verdict::accepted));
  BOOST_TEST(dialogue.master.is_over());
  BOOST_TEST(dialogue.actions.empty());
  dialogue.wait(5);
  BOOST_TEST(dialogue.while_waiting.empty());
}

BOOST_AUTO_TEST_CASE(one_rank_is_over_with_its_last_task) {
  Dialogue dialogue(Policy::dynamic, 2, 1);
  BOOST_TEST(dialogue.master.is_deserted());
  dialogue.say(TakeSeat{});
  BOOST_TEST((dialogue.assigned_to(0) == one_run(0, 1)));
  dialogue.say(Result{0, TaskId{0}, 1});
  dialogue.wait(100);  // its own task may last as long as it likes
  BOOST_TEST(dialogue.while_waiting.empty());
  BOOST_TEST(!dialogue.master.is_over());
  dialogue.say(Result{0, TaskId{1}, 1});
  BOOST_REQUIRE_EQUAL(dialogue.actions.size(), 1U);
  BOOST_TEST(std::holds_alternative<Done>(dialogue.actions[0]));
  BOOST_TEST(dialogue.master.is_over());
}

BOOST_AUTO_TEST_CASE(a_goodbye_that_nobody_asked_for_is_none) {
  Dialogue dialogue(Policy::dynamic, 30, 3);
  BOOST_TEST((dialogue.say(Bye{1}) == Verdict::unassigned));
  BOOST_TEST((dialogue.say(Result{1, TaskId{0}, 1}) == Verdict::accepted));
  BOOST_TEST(!dialogue.actions.empty());  // it is still there
}

BOOST_AUTO_TEST_CASE(a_second_goodbye_changes_nothing) {
  Dialogue dialogue = finished();
  dialogue.say(Bye{1});
  BOOST_TEST((dialogue.say(Bye{1}) == Verdict::duplicate));
  BOOST_TEST(!dialogue.master.is_over());
}

BOOST_AUTO_TEST_CASE(who_does_not_go_home_within_a_lease_is_given_up) {
  Dialogue dialogue = finished();
  dialogue.say(Bye{1});
  dialogue.wait(0.9);
  BOOST_TEST(dialogue.while_waiting.empty());
  dialogue.wait(0.2);
  BOOST_REQUIRE_EQUAL(dialogue.while_waiting.size(), 1U);
  BOOST_TEST(std::get<GiveUp>(dialogue.while_waiting[0]).rank == 2U);
  BOOST_TEST(dialogue.master.is_over());
  dialogue.wait(5);
  BOOST_TEST(dialogue.while_waiting.size() == 1U);
}

BOOST_AUTO_TEST_CASE(a_worker_on_its_way_home_is_waited_for_while_it_is_heard_of) {
  Dialogue dialogue = finished();
  dialogue.say(Bye{1});
  for (int i = 0; i < 5; ++i) {
    dialogue.wait(0.8);
    BOOST_TEST((dialogue.say(Alive{2}) == Verdict::accepted));
    BOOST_TEST(dialogue.actions.empty());
  }
  BOOST_TEST(dialogue.while_waiting.empty());
  BOOST_TEST((dialogue.say(Bye{2}) == Verdict::accepted));
  BOOST_TEST(dialogue.master.is_over());
}

BOOST_AUTO_TEST_CASE(the_goodbye_of_a_rank_that_was_given_up_is_no_breach) {
  // It was stopped for long, woke up, found its Stop and went, while another one is still waited for.
  Dialogue dialogue = finished();
  dialogue.wait(0.9);
  dialogue.say(Alive{1});
  dialogue.wait(0.2);
  BOOST_TEST(dialogue.count<GiveUp>(dialogue.while_waiting) == 1U);
  BOOST_TEST(!dialogue.master.is_over());
  BOOST_TEST((dialogue.say(Bye{2}) == Verdict::late));
  BOOST_TEST((dialogue.say(Bye{2}) == Verdict::duplicate));
  BOOST_TEST(!dialogue.master.is_over());
  BOOST_TEST((dialogue.say(Bye{1}) == Verdict::accepted));
  BOOST_TEST(dialogue.master.is_over());
}

BOOST_AUTO_TEST_CASE(what_was_under_way_when_all_was_done_is_late) {
  Plan plan = plan_of(Policy::dynamic, 2);
  Dialogue dialogue(plan, 3);  // rank 1 has both
  dialogue.wait(1.1);          // it is silent, rank 2 gets them
  BOOST_TEST((dialogue.say(Alive{1}) == Verdict::accepted));
  BOOST_TEST(dialogue.count<AskBack>(dialogue.actions) == 1U);
  dialogue.say(Result{2, TaskId{0}, 1});
  dialogue.say(Result{2, TaskId{1}, 1});
  BOOST_TEST(dialogue.master.is_done());
  BOOST_TEST((dialogue.say(Result{1, TaskId{0}, 1}) == Verdict::late));
  BOOST_TEST((dialogue.say(Returned{1, one_run(1, 1)}) == Verdict::accepted));
  BOOST_TEST((dialogue.say(Hello{1}) == Verdict::accepted));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST(dialogue.master.held_by(1) == 0U);
}

BOOST_AUTO_TEST_CASE(rank_0_gets_no_stop_and_no_seat_after_the_end) {
  Dialogue dialogue = finished();
  BOOST_TEST((dialogue.say(TakeSeat{}) == Verdict::duplicate));
  BOOST_TEST((dialogue.say(LeaveSeat{}) == Verdict::duplicate));
  BOOST_TEST(dialogue.actions.empty());
}

BOOST_AUTO_TEST_CASE(a_plan_without_tasks_sends_everybody_home_with_the_hello) {
  Dialogue dialogue(Policy::dynamic, 0, 3);
  BOOST_TEST(dialogue.master.is_done());
  BOOST_TEST(!dialogue.master.is_over());
  dialogue.say(TakeSeat{});
  BOOST_TEST(dialogue.actions.empty());
  for (const Rank rank : {2U, 1U}) {
    BOOST_TEST((dialogue.say(Hello{rank}) == Verdict::accepted));
    BOOST_REQUIRE_EQUAL(dialogue.actions.size(), 1U);
    BOOST_TEST(std::get<Stop>(dialogue.actions[0]).rank == rank);
    BOOST_TEST((dialogue.say(Bye{rank}) == Verdict::accepted));
  }
  BOOST_TEST(dialogue.master.is_over());
  dialogue.wait(3);
  BOOST_TEST(dialogue.while_waiting.empty());
  BOOST_TEST(Dialogue(Policy::dynamic, 0, 1).master.is_over());
}

BOOST_AUTO_TEST_CASE(a_plan_without_tasks_does_not_wait_for_ever) {
  Dialogue dialogue(Policy::dynamic, 0, 2);
  dialogue.wait(2.5);
  BOOST_TEST(dialogue.count<Stop>(dialogue.while_waiting) == 1U);
  BOOST_TEST(dialogue.count<GiveUp>(dialogue.while_waiting) == 1U);
  BOOST_TEST(dialogue.master.is_over());
}

BOOST_AUTO_TEST_CASE(with_an_infinite_lease_nobody_is_given_up) {
  Plan plan = plan_of(Policy::self_scheduling, 2);
  plan.lease_s = std::numeric_limits<double>::infinity();
  Dialogue dialogue(plan, 3);
  dialogue.wait(1e9);
  BOOST_TEST(dialogue.while_waiting.empty());
  dialogue.say(Result{1, TaskId{0}, 1});
  dialogue.wait(1e9);
  dialogue.say(Result{2, TaskId{1}, 1});
  dialogue.wait(1e9);
  BOOST_TEST(dialogue.while_waiting.empty());
  BOOST_TEST(!dialogue.master.is_over());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
