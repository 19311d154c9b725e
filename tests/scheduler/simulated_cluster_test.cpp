// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/simulated_cluster.h"

#include <boost/test/unit_test.hpp>
#include <stdexcept>
#include <vector>

#include "scheduler/all_policies.h"

namespace tessera::scheduler {
namespace {

Plan plan_of(Policy policy, std::size_t tasks, MasterRole role = MasterRole::automatic) {
  Plan plan;
  plan.policy = policy;
  plan.tasks = static_cast<std::uint32_t>(tasks);
  plan.role = role;
  return plan;
}

const auto nearly = boost::test_tools::tolerance(1e-9);

}  // namespace

BOOST_AUTO_TEST_SUITE(simulated_cluster)

BOOST_AUTO_TEST_CASE(one_rank_takes_as_long_as_its_tasks) {
  const SimulatedRun run = simulate({.ranks = 1}, plan_of(Policy::dynamic, 3), {0.1, 0.25, 0.05});
  BOOST_TEST(run.makespan_s == 0.4, nearly);
  BOOST_TEST(run.efficiency == 1.0, nearly);
  BOOST_TEST(run.messages == 0U);
}

// The task takes 10 ms, its result 1 ms on the wire and 0.1 ms at rank 0; the hello went before.
BOOST_AUTO_TEST_CASE(a_task_takes_its_time_and_that_of_its_result) {
  const Cluster cluster{.ranks = 2, .one_way_s = 1e-3, .master_per_message_s = 1e-4, .slice_s = 1e-4};
  const SimulatedRun run = simulate(cluster, plan_of(Policy::dynamic, 1, MasterRole::dedicated), {10e-3});
  BOOST_TEST(run.makespan_s == 11.1e-3, nearly);
  BOOST_TEST(run.messages == 2U);
  BOOST_TEST(run.tail_s == 1.1e-3, nearly);
}

// Rank 0 takes 4 us a result, and three workers want 1 us each: it is what everybody waits for.
BOOST_AUTO_TEST_CASE(rank_0_takes_one_message_after_the_other) {
  const Cluster cluster{.ranks = 4, .one_way_s = 0, .master_per_message_s = 4e-6, .slice_s = 1e-4};
  const SimulatedRun run =
      simulate(cluster, plan_of(Policy::dynamic, 1000, MasterRole::dedicated), std::vector<double>(1000, 1e-6));
  BOOST_TEST(run.makespan_s == 1003 * 4e-6, boost::test_tools::tolerance(1e-3));
}

// The only other rank delivers 1 us into a slice of rank 0's own task, and is heard when that ends.
BOOST_AUTO_TEST_CASE(mail_waits_for_the_end_of_a_slice) {
  const Cluster cluster{.ranks = 2, .one_way_s = 1e-6, .master_per_message_s = 0, .slice_s = 1e-3};
  Plan plan = plan_of(Policy::dynamic, 3, MasterRole::rendering);
  plan.prefetch = 1;
  const SimulatedRun run = simulate(cluster, plan, {10e-3, 20e-3, 20e-3});
  BOOST_TEST(run.makespan_s == 11e-3 + 1e-6 + 20e-3 + 1e-6, nearly);
}

// Rank 1 begins with both tasks, and gives the second one back before it has done the first.
BOOST_AUTO_TEST_CASE(an_idle_rank_gets_what_another_has_not_begun) {
  const Cluster cluster{.ranks = 2, .one_way_s = 1e-6, .master_per_message_s = 0, .slice_s = 1e-3};
  Plan plan = plan_of(Policy::dynamic, 2, MasterRole::rendering);
  BOOST_TEST(simulate(cluster, plan, {10e-3, 20e-3}).makespan_s == 2e-6 + 20e-3, nearly);
  plan.ask_back = false;
  BOOST_TEST(simulate(cluster, plan, {10e-3, 20e-3}).makespan_s == 30e-3 + 1e-6, nearly);
}

BOOST_AUTO_TEST_CASE(every_policy_does_all_of_the_work_once) {
  std::vector<double> task_s;
  double work_s = 0;
  for (int i = 0; i != 500; ++i) work_s += task_s.emplace_back(1e-4 * (1 + i % 7));
  for (const Policy policy : kAllPolicies) {
    for (const std::uint32_t ranks : {1U, 2U, 5U, 64U, 1024U}) {
      for (const bool is_predicted : {false, true}) {
        Plan plan = plan_of(policy, task_s.size());
        if (is_predicted) plan.costs = task_s;
        const SimulatedRun run = simulate({.ranks = ranks}, plan, task_s);
        BOOST_TEST(run.busy_s == work_s, nearly);
        BOOST_TEST(run.efficiency <= 1.0 + 1e-9);
        BOOST_TEST(run.makespan_s >= 7e-4);
      }
    }
  }
}

// Graham: no list schedule takes longer than W/P + (1 - 1/P) t_max, where nothing lies between asking and getting.
BOOST_AUTO_TEST_CASE(without_delays_one_task_at_a_time_stays_below_grahams_bound) {
  std::vector<double> task_s;
  double work_s = 0;
  for (int i = 0; i != 300; ++i) work_s += task_s.emplace_back(1e-3 * (1 + i * i % 31));
  for (const std::uint32_t ranks : {2U, 3U, 16U, 100U}) {
    const Cluster cluster{.ranks = ranks, .one_way_s = 0, .master_per_message_s = 0, .slice_s = 1e-7};
    const SimulatedRun run = simulate(cluster, plan_of(Policy::self_scheduling, 300, MasterRole::rendering), task_s);
    BOOST_TEST(run.makespan_s <= work_s / ranks + (1 - 1.0 / ranks) * 31e-3 + 1e-6);
  }
}

// What a study with another program found for 10 ms of round trip, 5 ms tasks and 32 ranks: 0.35, 0.70, 0.94, 0.98,
// 0.99.
BOOST_AUTO_TEST_CASE(as_many_tasks_are_held_as_the_wire_is_long) {
  const Cluster cluster{.ranks = 32, .one_way_s = 5e-3};
  const std::vector<double> task_s(32 * 200, 5e-3);
  Plan plan = plan_of(Policy::dynamic, task_s.size());
  const double found = simulate(cluster, plan, task_s).efficiency;
  const auto with = [&](unsigned prefetch) {
    plan.prefetch = prefetch;
    return simulate(cluster, plan, task_s).efficiency;
  };
  BOOST_TEST(with(1) < 0.4);
  BOOST_TEST(with(2) < 0.75);
  BOOST_TEST(with(4) > 0.97);
  BOOST_TEST(found > 0.97);
  plan.prefetch.reset();
  BOOST_TEST(found > 0.979 * simulate({.ranks = 32, .one_way_s = 0}, plan, task_s).efficiency);
}

BOOST_AUTO_TEST_CASE(one_master_keeps_hundreds_of_ranks_busy) {
  const auto efficiency = [](std::uint32_t ranks, double task_s) {
    const std::vector<double> tasks(std::size_t{ranks} * 100, task_s);
    return simulate({.ranks = ranks, .master_per_message_s = 2.2e-6}, plan_of(Policy::dynamic, tasks.size()), tasks)
        .efficiency;
  };
  BOOST_TEST(efficiency(448, 1e-3) > 0.9);
  BOOST_TEST(efficiency(3584, 10e-3) > 0.9);
}

BOOST_AUTO_TEST_CASE(a_plan_that_is_not_feasible_is_refused) {
  BOOST_CHECK_THROW(simulate({.ranks = 1}, plan_of(Policy::dynamic, 1, MasterRole::dedicated), {1.0}),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
