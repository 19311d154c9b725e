// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/plan.h"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>

namespace tessera::scheduler {
namespace {

Plan plan_of(Policy policy, MasterRole role) {
  Plan plan;
  plan.policy = policy;
  plan.role = role;
  plan.tasks = 3;
  return plan;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(plan)

BOOST_AUTO_TEST_CASE(every_name_leads_back_to_its_role) {
  for (const MasterRole role : {MasterRole::automatic, MasterRole::dedicated, MasterRole::rendering}) {
    BOOST_TEST((parse_master_role(name_of(role)) == role));
  }
  BOOST_TEST((parse_master_role("auto") == MasterRole::automatic));
  BOOST_TEST(!parse_master_role("automatic"));
}

BOOST_AUTO_TEST_CASE(a_dedicated_master_needs_a_worker) {
  const Plan dedicated = plan_of(Policy::dynamic, MasterRole::dedicated);
  BOOST_CHECK_THROW(require_feasible(dedicated, 1), std::invalid_argument);
  BOOST_CHECK_NO_THROW(require_feasible(dedicated, 2));
}

BOOST_AUTO_TEST_CASE(a_dedicated_master_cannot_own_tasks) {
  for (const Policy policy : {Policy::static_bands, Policy::cyclic_rows}) {
    BOOST_CHECK_THROW(require_feasible(plan_of(policy, MasterRole::dedicated), 4), std::invalid_argument);
    BOOST_CHECK_NO_THROW(require_feasible(plan_of(policy, MasterRole::automatic), 4));
  }
}

BOOST_AUTO_TEST_CASE(nonsense_is_refused) {
  Plan plan = plan_of(Policy::dynamic, MasterRole::automatic);
  BOOST_CHECK_THROW(require_feasible(plan, 0), std::invalid_argument);
  plan.prefetch = 0;
  BOOST_CHECK_THROW(require_feasible(plan, 2), std::invalid_argument);
  plan.prefetch = 1;
  BOOST_CHECK_NO_THROW(require_feasible(plan, 2));
}

BOOST_AUTO_TEST_CASE(costs_are_one_finite_number_per_task) {
  Plan plan = plan_of(Policy::dynamic, MasterRole::automatic);
  plan.costs = {1, 0, 2.5};
  BOOST_CHECK_NO_THROW(require_feasible(plan, 2));
  plan.costs = {1, 2};
  BOOST_CHECK_THROW(require_feasible(plan, 2), std::invalid_argument);
  plan.costs = {1, -1, 2};
  BOOST_CHECK_THROW(require_feasible(plan, 2), std::invalid_argument);
  plan.costs = {1, std::numeric_limits<double>::infinity(), 2};
  BOOST_CHECK_THROW(require_feasible(plan, 2), std::invalid_argument);
  plan.costs = {1, std::numeric_limits<double>::quiet_NaN(), 2};
  BOOST_CHECK_THROW(require_feasible(plan, 2), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(explicit_roles_are_obeyed) {
  const Workload tiny{.ranks = 1000, .tasks = 1, .mean_task_s = 1e-6};
  BOOST_TEST(should_render(plan_of(Policy::dynamic, MasterRole::rendering), tiny));
  const Workload huge{.ranks = 2, .tasks = 1000000, .mean_task_s = 1.0};
  BOOST_TEST(!should_render(plan_of(Policy::dynamic, MasterRole::dedicated), huge));
}

BOOST_AUTO_TEST_CASE(the_owner_of_tasks_renders_them) {
  const Workload tiny{.ranks = 1000, .tasks = 1000, .mean_task_s = 1e-6};
  BOOST_TEST(should_render(plan_of(Policy::static_bands, MasterRole::automatic), tiny));
  BOOST_TEST(should_render(plan_of(Policy::cyclic_rows, MasterRole::automatic), tiny));
}

BOOST_AUTO_TEST_CASE(up_to_four_ranks_rank_0_renders_whatever_the_tasks) {
  const Plan automatic = plan_of(Policy::dynamic, MasterRole::automatic);
  for (const std::uint32_t ranks : {1U, 2U, 3U, 4U}) {
    BOOST_TEST(should_render(automatic, {.ranks = ranks, .tasks = 1, .mean_task_s = {}}));
    BOOST_TEST(should_render(automatic, {.ranks = ranks, .tasks = 1, .mean_task_s = 1e-6}));
  }
}

BOOST_AUTO_TEST_CASE(on_more_ranks_rank_0_renders_once_it_knows_that_there_is_work_enough) {
  const Plan automatic = plan_of(Policy::dynamic, MasterRole::automatic);
  BOOST_TEST(!should_render(automatic, {.ranks = 16, .tasks = 100000, .mean_task_s = {}}));
  // P = 16: x = 100 is W = 0.0768 s, a duty of 0.5 is t = 90 us.
  BOOST_TEST(should_render(automatic, {.ranks = 16, .tasks = 385, .mean_task_s = 200e-6}));
  BOOST_TEST(!should_render(automatic, {.ranks = 16, .tasks = 383, .mean_task_s = 200e-6}));
  BOOST_TEST(should_render(automatic, {.ranks = 16, .tasks = 100000, .mean_task_s = 91e-6}));
  BOOST_TEST(!should_render(automatic, {.ranks = 16, .tasks = 100000, .mean_task_s = 89e-6}));
}

BOOST_AUTO_TEST_CASE(predicted_costs_settle_the_role_at_the_start) {
  Plan plan = plan_of(Policy::dynamic, MasterRole::automatic);
  plan.tasks = 400;
  BOOST_TEST((settled_role(plan, 16) == MasterRole::automatic));
  plan.costs.assign(400, 200e-6);
  BOOST_TEST((settled_role(plan, 16) == MasterRole::rendering));
  BOOST_TEST((settled_role(plan, 17) == MasterRole::dedicated));  // x = 92
  BOOST_TEST((settled_role(plan, 2) == MasterRole::rendering));
  plan.role = MasterRole::dedicated;
  BOOST_TEST((settled_role(plan, 16) == MasterRole::dedicated));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
