// SPDX-License-Identifier: BSD-3-Clause
// Ranks that fall silent, come back, or deliver rubbish. The lease is one second.
#include <boost/test/unit_test.hpp>
#include <vector>

#include "scheduler/dialogue.h"

namespace tessera::scheduler {
namespace {

// One task at a time, so that what is assigned is plain to see. Rank 1 has task 0, rank 2 has task 1, and so on.
Dialogue one_at_a_time(std::uint32_t tasks, std::uint32_t ranks) {
  return Dialogue(Policy::self_scheduling, tasks, ranks);
}

// Rank 2 keeps in touch until rank 1 has been silent for longer than a lease.
void let_rank_1_fall_silent(Dialogue& dialogue) {
  dialogue.wait(0.6);
  dialogue.say(Alive{2});
  BOOST_TEST(dialogue.actions.empty());
  dialogue.wait(0.5);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(master_faults)

BOOST_AUTO_TEST_CASE(the_task_of_a_silent_rank_is_handed_out_before_all_others) {
  Dialogue dialogue = one_at_a_time(10, 3);
  let_rank_1_fall_silent(dialogue);
  BOOST_TEST(dialogue.while_waiting.empty());  // nobody was idle
  BOOST_TEST(dialogue.master.faults().silences == 1U);
  BOOST_TEST(dialogue.master.faults().reissued == 1U);
  dialogue.say(Result{2, TaskId{1}, 1});
  BOOST_TEST((dialogue.assigned_to(2) == one_run(0, 1)));
  dialogue.say(Result{2, TaskId{0}, 1});
  BOOST_TEST((dialogue.assigned_to(2) == one_run(2, 1)));
}

BOOST_AUTO_TEST_CASE(an_idle_rank_gets_the_task_of_a_silent_one_at_once) {
  Dialogue dialogue = one_at_a_time(2, 4);  // rank 3 has nothing to do
  dialogue.wait(0.6);
  dialogue.say(Alive{2});
  dialogue.wait(0.5);
  BOOST_REQUIRE_EQUAL(dialogue.while_waiting.size(), 1U);
  const auto assign = std::get<Assign>(dialogue.while_waiting[0]);
  BOOST_TEST(assign.rank == 3U);
  BOOST_TEST((assign.runs == one_run(0, 1)));
}

BOOST_AUTO_TEST_CASE(every_sign_of_life_renews_the_lease) {
  Dialogue dialogue = one_at_a_time(20, 2);
  std::uint32_t task = 0;
  for (int i = 0; i < 4; ++i) {
    dialogue.wait(0.8);
    dialogue.say(Result{1, TaskId{task++}, 1});
    dialogue.wait(0.8);
    dialogue.say(Alive{1});
    dialogue.wait(0.8);
    dialogue.say(Damaged{1, TaskId{19}});
    if (i == 1) break;  // the third damage would count against it
  }
  dialogue.wait(0.8);
  dialogue.say(Returned{1, {}});
  dialogue.wait(0.8);
  dialogue.say(Hello{1});
  dialogue.wait(0.8);
  BOOST_TEST(dialogue.while_waiting.empty());
  BOOST_TEST(dialogue.master.faults().silences == 0U);
  BOOST_TEST(!dialogue.master.is_deserted());
}

BOOST_AUTO_TEST_CASE(a_rank_without_tasks_has_nothing_to_say) {
  Dialogue dialogue = one_at_a_time(1, 3);
  for (int i = 0; i < 5; ++i) {
    dialogue.wait(0.8);
    dialogue.say(Alive{1});
  }
  BOOST_TEST(dialogue.master.faults().silences == 0U);

  // Its lease begins with the task that it gets
  dialogue.say(Returned{1, one_run(0, 1)});
  BOOST_TEST((dialogue.assigned_to(2) == one_run(0, 1)));
  dialogue.wait(0.9);
  BOOST_TEST(dialogue.master.faults().silences == 0U);
  dialogue.wait(0.2);
  BOOST_TEST(dialogue.master.faults().silences == 1U);
}

BOOST_AUTO_TEST_CASE(the_first_copy_counts) {
  for (const Rank first : {1U, 2U}) {
    const Rank second = 3 - first;
    Dialogue dialogue = one_at_a_time(10, 3);
    let_rank_1_fall_silent(dialogue);
    dialogue.say(Result{2, TaskId{1}, 1});
    BOOST_TEST((dialogue.say(Result{first, TaskId{0}, 1}) == Verdict::accepted));
    BOOST_TEST(dialogue.master.accepted() == 2U);
    BOOST_TEST((dialogue.say(Result{second, TaskId{0}, 1}) == Verdict::late));
    BOOST_TEST(dialogue.master.accepted() == 2U);
    BOOST_TEST(dialogue.master.faults().late == 1U);
    BOOST_TEST(dialogue.count<Assign>(dialogue.actions) == 1U);  // a late result is a request for more, too
    BOOST_TEST((dialogue.say(Result{second, TaskId{0}, 1}) == Verdict::duplicate));
  }
}

BOOST_AUTO_TEST_CASE(a_late_result_of_a_task_that_nobody_else_has_is_in_time) {
  Dialogue dialogue = one_at_a_time(10, 3);
  let_rank_1_fall_silent(dialogue);
  BOOST_TEST((dialogue.say(Result{1, TaskId{0}, 1}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(1) == one_run(2, 1)));
  BOOST_TEST((dialogue.say(Result{2, TaskId{1}, 1}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(2) == one_run(3, 1)));  // task 0 is not handed out again
}

BOOST_AUTO_TEST_CASE(who_is_heard_of_again_gets_its_tasks_back_unless_others_have_them) {
  Plan plan = plan_of(Policy::dynamic, 20);
  plan.prefetch = 3;
  Dialogue dialogue(plan, 3);  // rank 1 has 0, 1, 2 and rank 2 has 3, 4, 5
  let_rank_1_fall_silent(dialogue);
  dialogue.say(Result{2, TaskId{3}, 1});
  BOOST_TEST((dialogue.assigned_to(2) == one_run(0, 1)));
  BOOST_TEST(dialogue.master.held_by(1) == 3U);

  // It is asked for what others have
  BOOST_TEST((dialogue.say(Alive{1}) == Verdict::accepted));
  BOOST_REQUIRE_EQUAL(dialogue.actions.size(), 1U);
  BOOST_TEST(std::get<AskBack>(dialogue.actions[0]).rank == 1U);
  BOOST_TEST(std::get<AskBack>(dialogue.actions[0]).tasks >= 1U);
  dialogue.say(Result{2, TaskId{4}, 1});
  BOOST_TEST((dialogue.assigned_to(2) == one_run(6, 1)));  // 1 and 2 are with rank 1 again

  // What it gives back of that is nobody's, what it gives back of its own is handed out
  BOOST_TEST((dialogue.say(Returned{1, one_run(0, 1)}) == Verdict::accepted));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST((dialogue.say(Returned{1, one_run(2, 1)}) == Verdict::accepted));
  BOOST_TEST((dialogue.say(Result{2, TaskId{5}, 1}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(2) == one_run(2, 1)));
  BOOST_TEST((dialogue.say(Result{1, TaskId{1}, 1}) == Verdict::accepted));
}

BOOST_AUTO_TEST_CASE(who_is_heard_of_again_in_time_to_have_all_its_tasks_is_asked_for_none) {
  Dialogue dialogue = one_at_a_time(10, 3);
  let_rank_1_fall_silent(dialogue);
  BOOST_TEST((dialogue.say(Alive{1}) == Verdict::accepted));
  BOOST_TEST(dialogue.actions.empty());
  dialogue.say(Result{2, TaskId{1}, 1});
  BOOST_TEST((dialogue.assigned_to(2) == one_run(2, 1)));

  // And it can fall silent again
  dialogue.wait(0.6);
  dialogue.say(Alive{2});
  dialogue.wait(0.5);
  BOOST_TEST(dialogue.master.faults().silences == 2U);
  dialogue.say(Result{2, TaskId{2}, 1});
  BOOST_TEST((dialogue.assigned_to(2) == one_run(0, 1)));
}

BOOST_AUTO_TEST_CASE(nothing_is_assigned_to_a_silent_rank) {
  Dialogue dialogue = one_at_a_time(4, 3);
  let_rank_1_fall_silent(dialogue);
  for (const std::uint32_t task : {1U, 0U, 2U}) dialogue.say(Result{2, TaskId{task}, 1});
  for (const Action& action : dialogue.actions) BOOST_TEST(std::get<Assign>(action).rank == 2U);
  BOOST_TEST(dialogue.master.held_by(1) == 1U);
}

BOOST_AUTO_TEST_CASE(rank_0_takes_over_where_everybody_is_lost) {
  Dialogue dialogue = one_at_a_time(4, 3);
  BOOST_TEST(!dialogue.master.is_deserted());
  dialogue.wait(0.6);
  dialogue.say(Alive{2});
  dialogue.wait(0.5);
  BOOST_TEST(!dialogue.master.is_deserted());
  dialogue.wait(0.6);
  BOOST_TEST(dialogue.master.is_deserted());
  dialogue.say(TakeSeat{});
  for (const std::uint32_t task : {0U, 1U, 2U, 3U}) {
    BOOST_TEST((dialogue.assigned_to(0) == one_run(task, 1)));
    BOOST_TEST((dialogue.say(Result{0, TaskId{task}, 1}) == Verdict::accepted));
  }
  BOOST_TEST(dialogue.count<Stop>(dialogue.actions) == 2U);
  BOOST_TEST(dialogue.count<Done>(dialogue.actions) == 1U);
  dialogue.wait(1.1);
  BOOST_TEST(dialogue.count<GiveUp>(dialogue.while_waiting) == 2U);
  BOOST_TEST(dialogue.master.is_over());
}

BOOST_AUTO_TEST_CASE(a_deserted_master_is_no_more_when_somebody_comes_back) {
  Dialogue dialogue = one_at_a_time(4, 2);
  dialogue.wait(1.1);
  BOOST_TEST(dialogue.master.is_deserted());
  dialogue.say(TakeSeat{});
  dialogue.say(Result{1, TaskId{0}, 1});
  BOOST_TEST(!dialogue.master.is_deserted());
  BOOST_TEST((dialogue.say(LeaveSeat{}) == Verdict::accepted));
}

BOOST_AUTO_TEST_CASE(owned_tasks_of_a_silent_rank_are_done_by_others) {
  Dialogue dialogue(Policy::static_bands, 3, 3);
  dialogue.say(TakeSeat{});
  dialogue.say(Result{0, TaskId{0}, 1});
  let_rank_1_fall_silent(dialogue);
  BOOST_REQUIRE_EQUAL(dialogue.while_waiting.size(), 1U);
  BOOST_TEST(std::get<Assign>(dialogue.while_waiting[0]).rank == 0U);
  BOOST_TEST((std::get<Assign>(dialogue.while_waiting[0]).runs == one_run(1, 1)));
}

BOOST_AUTO_TEST_CASE(what_a_silent_rank_owns_and_has_not_had_yet_is_done_by_others) {
  Plan plan = plan_of(Policy::cyclic_rows, 6);
  plan.prefetch = 1;
  Dialogue dialogue(plan, 2);  // rank 1 owns 1, 3 and 5, and has had 1
  dialogue.wait(1.1);
  dialogue.say(TakeSeat{});
  for (const std::uint32_t task : {1U, 3U, 5U, 0U, 2U, 4U}) {
    BOOST_TEST((dialogue.assigned_to(0) == one_run(task, 1)));
    BOOST_TEST((dialogue.say(Result{0, TaskId{task}, 1}) == Verdict::accepted));
  }
  BOOST_TEST(dialogue.master.is_done());
  BOOST_TEST(dialogue.master.faults().reissued == 1U);
}

BOOST_AUTO_TEST_CASE(rank_0_is_never_silent) {
  Dialogue dialogue = one_at_a_time(4, 2);
  dialogue.say(TakeSeat{});
  for (int i = 0; i < 4; ++i) {
    dialogue.wait(0.8);
    dialogue.say(Alive{1});
  }
  BOOST_TEST(dialogue.master.faults().silences == 0U);
  BOOST_TEST((dialogue.say(Result{0, TaskId{1}, 1}) == Verdict::accepted));
}

BOOST_AUTO_TEST_CASE(who_was_away_itself_blames_nobody) {
  Dialogue dialogue = one_at_a_time(4, 2);
  dialogue.wait(0.5);
  dialogue.now_s += 50;  // rank 0 was stopped; the first thing that it notices is the time
  dialogue.say(Tick{});
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST(dialogue.master.faults().silences == 0U);
  dialogue.wait(0.4);
  BOOST_TEST(dialogue.master.faults().silences == 0U);
  dialogue.wait(0.2);  // half a second before and more than half a second after
  BOOST_TEST(dialogue.master.faults().silences == 1U);
}

BOOST_AUTO_TEST_CASE(who_was_away_itself_gives_nobody_up) {
  Dialogue dialogue = one_at_a_time(1, 2);
  dialogue.say(Result{1, TaskId{0}, 1});
  BOOST_TEST(dialogue.master.is_done());
  dialogue.now_s += 50;
  dialogue.say(Tick{});
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST((dialogue.say(Bye{1}) == Verdict::accepted));
  BOOST_TEST(dialogue.master.is_over());
}

BOOST_AUTO_TEST_CASE(a_damaged_result_is_done_again) {
  Dialogue dialogue = one_at_a_time(4, 2);
  BOOST_TEST((dialogue.say(Damaged{1, TaskId{0}}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(1) == one_run(0, 1)));
  BOOST_TEST(dialogue.master.held_by(1) == 1U);
  BOOST_TEST(dialogue.master.accepted() == 0U);
  BOOST_TEST(dialogue.master.faults().damaged == 1U);
  BOOST_TEST(dialogue.master.faults().reissued == 1U);
  BOOST_TEST((dialogue.say(Result{1, TaskId{0}, 1}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(1) == one_run(1, 1)));
}

BOOST_AUTO_TEST_CASE(a_damaged_result_goes_to_who_is_idle) {
  Dialogue dialogue = one_at_a_time(1, 3);
  dialogue.say(Damaged{1, TaskId{0}});
  BOOST_TEST((dialogue.assigned_to(2) == one_run(0, 1)));
}

BOOST_AUTO_TEST_CASE(a_damaged_copy_is_not_missed) {
  Dialogue dialogue = one_at_a_time(3, 3);
  let_rank_1_fall_silent(dialogue);
  dialogue.say(Result{2, TaskId{1}, 1});
  BOOST_TEST((dialogue.assigned_to(2) == one_run(0, 1)));
  dialogue.say(Damaged{1, TaskId{0}});
  BOOST_TEST(dialogue.master.held_by(1) == 1U);  // task 2; task 0 is with rank 2
  BOOST_TEST(dialogue.master.faults().reissued == 1U);
  BOOST_TEST((dialogue.say(Result{2, TaskId{0}, 1}) == Verdict::accepted));
}

BOOST_AUTO_TEST_CASE(a_damaged_result_that_names_a_wrong_task_costs_a_lease) {
  for (const std::uint32_t wrong : {1U, 9U, 10U, 0xffffffffU}) {
    Dialogue dialogue = one_at_a_time(10, 3);
    BOOST_TEST((dialogue.say(Damaged{1, TaskId{wrong}}) == Verdict::accepted));
    BOOST_TEST(dialogue.actions.empty());
    BOOST_TEST(dialogue.master.faults().damaged == 1U);
    BOOST_TEST(dialogue.master.faults().reissued == 0U);
    let_rank_1_fall_silent(dialogue);
    dialogue.say(Result{2, TaskId{1}, 1});
    BOOST_TEST((dialogue.assigned_to(2) == one_run(0, 1)));
  }
}

BOOST_AUTO_TEST_CASE(a_damaged_result_that_names_another_task_of_the_rank_breaks_nothing) {
  // Task 0 arrives broken and says that it is task 1, which rank 1 then delivers as well.
  Dialogue dialogue(Policy::dynamic, 2, 3);
  BOOST_TEST((dialogue.say(Damaged{1, TaskId{1}}) == Verdict::accepted));
  BOOST_TEST((dialogue.assigned_to(2) == one_run(1, 1)));
  BOOST_TEST((dialogue.say(Result{1, TaskId{1}, 1}) == Verdict::late));
  BOOST_TEST((dialogue.say(Result{2, TaskId{1}, 1}) == Verdict::accepted));

  // Task 0 is missed a lease later
  dialogue.wait(1.1);
  BOOST_TEST(dialogue.count<Assign>(dialogue.while_waiting) == 1U);
  BOOST_TEST((dialogue.say(Result{2, TaskId{0}, 1}) == Verdict::accepted));
  BOOST_TEST(dialogue.master.is_done());
}

BOOST_AUTO_TEST_CASE(a_rank_that_gave_a_wrong_number_goes_on_working) {
  Dialogue dialogue(Policy::dynamic, 9, 2);  // rank 1 has 0 and 1
  dialogue.say(Damaged{1, TaskId{1}});
  dialogue.say(Returned{1, one_run(1, 1)});
  BOOST_TEST((dialogue.say(Returned{1, one_run(1, 1)}) == Verdict::accepted));
  BOOST_TEST((dialogue.say(Result{1, TaskId{1}, 1}) == Verdict::late));
  BOOST_TEST(dialogue.count<Assign>(dialogue.actions) == 1U);
  BOOST_TEST(dialogue.master.held_by(1) == 2U);
}

BOOST_AUTO_TEST_CASE(who_delivers_rubbish_three_times_gets_nothing_more) {
  Dialogue dialogue = one_at_a_time(10, 3);
  for (int times = 0; times < 2; ++times) {
    dialogue.say(Damaged{1, TaskId{0}});
    BOOST_TEST((dialogue.assigned_to(1) == one_run(0, 1)));
  }
  BOOST_TEST((dialogue.say(Damaged{1, TaskId{0}}) == Verdict::accepted));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST(dialogue.master.held_by(1) == 0U);
  for (const Event& event : std::vector<Event>{Alive{1}, Hello{1}, Returned{1, {}}}) {
    BOOST_TEST((dialogue.say(event) == Verdict::accepted));
    BOOST_TEST(dialogue.actions.empty());
  }
  dialogue.say(Result{2, TaskId{1}, 1});
  BOOST_TEST((dialogue.assigned_to(2) == one_run(0, 1)));
}

BOOST_AUTO_TEST_CASE(the_other_tasks_of_who_delivers_rubbish_are_handed_out_again_and_may_still_come) {
  Plan plan = plan_of(Policy::dynamic, 8);
  plan.prefetch = 4;
  Dialogue dialogue(plan, 3);
  for (const std::uint32_t task : {0U, 1U, 2U}) dialogue.say(Damaged{1, TaskId{task}});
  // Task 0 came back to it after the first time, and so did task 1
  BOOST_TEST(dialogue.master.held_by(1) >= 1U);
  BOOST_TEST((dialogue.say(Result{1, TaskId{3}, 1}) == Verdict::accepted));
  BOOST_TEST(dialogue.actions.empty());
  BOOST_TEST((dialogue.say(Result{1, TaskId{3}, 1}) != Verdict::accepted));
}

BOOST_AUTO_TEST_CASE(where_all_deliver_rubbish_rank_0_takes_over) {
  Dialogue dialogue = one_at_a_time(2, 2);
  for (int times = 0; times < 3; ++times) dialogue.say(Damaged{1, TaskId{0}});
  BOOST_TEST(dialogue.master.is_deserted());
  dialogue.say(TakeSeat{});
  BOOST_TEST((dialogue.assigned_to(0) == one_run(0, 1)));
  dialogue.say(Result{0, TaskId{0}, 1});
  dialogue.say(Result{0, TaskId{1}, 1});
  BOOST_TEST(dialogue.master.is_done());
}

BOOST_AUTO_TEST_CASE(who_delivered_rubbish_has_a_lease_to_go_home_all_the_same) {
  Dialogue dialogue = one_at_a_time(2, 2);
  for (int times = 0; times < 3; ++times) dialogue.say(Damaged{1, TaskId{0}});
  dialogue.say(TakeSeat{});
  dialogue.wait(2);  // it has nothing to do, and nothing to say
  dialogue.say(Result{0, TaskId{0}, 1});
  dialogue.say(Result{0, TaskId{1}, 1});
  BOOST_TEST(dialogue.count<Stop>(dialogue.actions) == 1U);
  dialogue.wait(0.5);
  BOOST_TEST(dialogue.count<GiveUp>(dialogue.while_waiting) == 0U);
  BOOST_TEST((dialogue.say(Bye{1}) == Verdict::accepted));
  BOOST_TEST(dialogue.master.is_over());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
