// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/run.h"

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "scheduler/all_policies.h"
#include "scheduler/metrics.h"
#include "scheduler/mpi/session_for_tests.h"
#include "scheduler/mpi/transport.h"

namespace tessera::scheduler::mpi {
namespace {

using SizeOf = std::function<std::size_t(TaskId)>;

std::byte fill_of(TaskId task) {
  return static_cast<std::byte>(index_of(task) * 3 + 1);
}

// Runs the plan on all ranks, with results of these sizes; on rank 0 checks what arrives and returns the record.
RunRecord run_checked(const Plan& plan, const SizeOf& size_of) {
  Session& session = session_for_tests();
  MpiTransport transport(session);
  const Work work = [&](TaskId task, const auto& between_slices) {
    between_slices();
    return Bytes(size_of(task), fill_of(task));
  };
  session.barrier();
  if (session.rank() != kMasterRank) {
    run_worker(transport, plan, work);
    session.barrier();
    return {};
  }
  std::vector<int> times(plan.tasks, 0);
  const RunRecord run = run_master(transport, plan, work, [&](TaskId task, std::span<const std::byte> payload) {
    ++times.at(index_of(task));
    BOOST_TEST((Bytes(payload.begin(), payload.end()) == Bytes(size_of(task), fill_of(task))));
  });
  for (const int count : times) BOOST_TEST(count == 1);
  BOOST_TEST(run.ranks.size() == session.size());
  if (session.size() == 1) BOOST_TEST((run.messages == Traffic{}));
  session.barrier();
  return run;
}

Plan plan_of(Policy policy, std::uint32_t tasks, MasterRole role = MasterRole::automatic) {
  Plan plan;
  plan.policy = policy;
  plan.tasks = tasks;
  plan.role = role;
  return plan;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(run)

BOOST_AUTO_TEST_CASE(every_policy_and_role_comes_to_its_end) {
  for (const Policy policy : kAllPolicies) {
    BOOST_TEST_CONTEXT(name_of(policy)) {
      for (const MasterRole role : {MasterRole::automatic, MasterRole::dedicated, MasterRole::rendering}) {
        const bool impossible =
            role == MasterRole::dedicated && (has_owners(policy) || session_for_tests().size() == 1);
        if (impossible) continue;
        run_checked(plan_of(policy, 500, role), [](TaskId task) { return index_of(task) % 3000; });
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(large_results_arrive) {
  run_checked(plan_of(Policy::dynamic, 12), [](TaskId) { return std::size_t{20'000'000}; });
}

BOOST_AUTO_TEST_CASE(large_and_small_results_arrive_together) {
  run_checked(plan_of(Policy::dynamic, 100), [](TaskId task) { return index_of(task) % 3 == 0 ? 300'000U : 10U; });
}

BOOST_AUTO_TEST_CASE(empty_results_arrive) {
  run_checked(plan_of(Policy::guided, 2000), [](TaskId) { return std::size_t{0}; });
}

BOOST_AUTO_TEST_CASE(fewer_tasks_than_ranks_are_enough) {
  for (const std::uint32_t tasks : {0U, 1U, 2U}) {
    run_checked(plan_of(Policy::dynamic, tasks), [](TaskId) { return std::size_t{10}; });
  }
}

BOOST_AUTO_TEST_CASE(runs_can_follow_each_other_at_once) {
  for (int i = 0; i < 50; ++i) run_checked(plan_of(Policy::self_scheduling, 7), [](TaskId) { return std::size_t{5}; });
}

BOOST_AUTO_TEST_CASE(a_rank_that_stands_still_for_some_leases_costs_no_result) {
  Session& session = session_for_tests();
  MpiTransport transport(session);
  Plan plan = plan_of(Policy::dynamic, 200);
  plan.lease_s = 0.03;
  int tasks_of_this_rank = 0;
  const Work work = [&](TaskId task, const auto& between_slices) {
    const bool stands_still = session.rank() + 1 == session.size() && ++tasks_of_this_rank == 5;
    if (stands_still && session.rank() != kMasterRank) std::this_thread::sleep_for(std::chrono::milliseconds(150));
    between_slices();
    return Bytes(20, fill_of(task));
  };
  session.barrier();
  if (session.rank() == kMasterRank) {
    std::vector<int> times(plan.tasks, 0);
    run_master(transport, plan, work, [&](TaskId task, std::span<const std::byte> payload) {
      ++times.at(index_of(task));
      BOOST_TEST((Bytes(payload.begin(), payload.end()) == Bytes(20, fill_of(task))));
    });
    for (const int count : times) BOOST_TEST(count == 1);
  } else {
    run_worker(transport, plan, work);
  }
  session.barrier();

  // Who was given up came home after the end: take what it still sent, up to an empty message from each
  if (session.rank() != kMasterRank) {
    transport.send(kMasterRank, Bytes());
    transport.flush();
  } else {
    for (Rank ends = 1; ends < session.size();) {
      if (const auto envelope = transport.receive(); envelope && envelope->bytes.empty()) ++ends;
    }
  }
  session.barrier();
}

BOOST_AUTO_TEST_CASE(the_balance_of_a_run_is_within_its_limits) {
  const RunRecord run = run_checked(plan_of(Policy::dynamic, 3000), [](TaskId) { return std::size_t{3000}; });
  if (session_for_tests().rank() != kMasterRank) return;
  const Balance balance = balance_of(run);
  BOOST_TEST(balance.efficiency > 0.0);
  BOOST_TEST(balance.efficiency <= 1.0);
  BOOST_TEST(balance.load_balance <= 1.0);
  BOOST_TEST(balance.tail_s <= run.makespan_s);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler::mpi
