// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/run.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "scheduler/all_policies.h"
#include "scheduler/by_hand.h"
#include "scheduler/loopback.h"
#include "scheduler/message.h"

namespace tessera::scheduler {
namespace {

// The result of a task: its number as many times as the number says, modulo something.
Bytes payload_of(TaskId task) {
  return Bytes(index_of(task) % 37, static_cast<std::byte>(index_of(task) % 251));
}

Bytes work(TaskId task, const std::function<void()>& between_slices) {
  for (std::uint32_t slice = 0; slice < index_of(task) % 4; ++slice) between_slices();
  return payload_of(task);
}

Plan plan_of(Policy policy, std::uint32_t tasks, MasterRole role = MasterRole::automatic) {
  Plan plan;
  plan.policy = policy;
  plan.tasks = tasks;
  plan.role = role;
  return plan;
}

// Runs a plan and checks that every task's own result was accepted once.
RunRecord run_checked(std::uint32_t ranks, std::uint64_t seed, const Plan& plan) {
  std::vector<int> times(plan.tasks, 0);
  const Accept accept = [&](TaskId task, std::span<const std::byte> payload) {
    ++times.at(index_of(task));
    const Bytes expected = payload_of(task);
    BOOST_TEST(std::equal(payload.begin(), payload.end(), expected.begin(), expected.end()));
  };
  RunRecord run = run_in_process(ranks, seed, plan, work, accept);
  for (const int count : times) BOOST_TEST(count == 1);
  return run;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(run)

BOOST_AUTO_TEST_CASE(every_task_is_accepted_once_whatever_the_ranks_and_the_order) {
  for (const Policy policy : kAllPolicies) {
    BOOST_TEST_CONTEXT(name_of(policy)) {
      for (std::uint32_t ranks = 1; ranks <= 9; ++ranks) {
        for (std::uint64_t seed = 0; seed < 30; ++seed) {
          BOOST_TEST_CONTEXT(ranks << " ranks, seed " << seed) {
            run_checked(ranks, seed, plan_of(policy, static_cast<std::uint32_t>(seed * 7 % 90)));
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(every_role_comes_to_an_end) {
  for (const MasterRole role : {MasterRole::automatic, MasterRole::dedicated, MasterRole::rendering}) {
    for (const std::uint32_t ranks : {2U, 3U, 8U}) {
      const RunRecord run = run_checked(ranks, 5, plan_of(Policy::dynamic, 300, role));
      if (role == MasterRole::dedicated) BOOST_TEST(run.ranks[0].tasks == 0U);
      if (role == MasterRole::rendering) BOOST_TEST(run.ranks[0].tasks > 0U);
    }
  }
}

BOOST_AUTO_TEST_CASE(owned_tasks_are_done_by_their_owners) {
  for (const Policy policy : {Policy::static_bands, Policy::cyclic_rows}) {
    const RunRecord run = run_checked(5, 1, plan_of(policy, 64));
    for (const TaskRecord& task : run.tasks) BOOST_TEST(task.rank == index_of(task.task) % 5);
  }
}

BOOST_AUTO_TEST_CASE(costs_and_prefetch_change_no_result) {
  Plan plan = plan_of(Policy::dynamic, 100);
  for (std::uint32_t task = 0; task < 100; ++task) plan.costs.push_back(task % 7);
  for (const unsigned prefetch : {1U, 2U, 40U}) {
    plan.prefetch = prefetch;
    run_checked(4, prefetch, plan);
  }
}

BOOST_AUTO_TEST_CASE(one_rank_does_each_task_in_order_without_a_message) {
  for (const Policy policy : kAllPolicies) {
    std::vector<std::uint32_t> order;
    const RunRecord run =
        run_in_process(1, 0, plan_of(policy, 20), work, [&](TaskId task, auto) { order.push_back(index_of(task)); });
    BOOST_REQUIRE_EQUAL(order.size(), 20U);
    BOOST_TEST(std::is_sorted(order.begin(), order.end()));
    BOOST_TEST((run.messages == Traffic{}));
    BOOST_TEST(run.ranks.at(0).tasks == 20U);
  }
}

BOOST_AUTO_TEST_CASE(the_record_adds_up) {
  const RunRecord run = run_checked(4, 3, plan_of(Policy::dynamic, 200));
  BOOST_REQUIRE_EQUAL(run.tasks.size(), 200U);
  BOOST_REQUIRE_EQUAL(run.ranks.size(), 4U);
  std::map<Rank, std::uint32_t> tasks;
  std::map<Rank, double> busy_s;
  std::uint64_t results = 0;
  std::uint64_t result_bytes = 0;
  for (std::uint32_t i = 0; i < run.tasks.size(); ++i) {
    const TaskRecord& task = run.tasks[i];
    BOOST_TEST(index_of(task.task) == i);
    BOOST_TEST(task.bytes == payload_of(TaskId{i}).size());
    BOOST_TEST(task.start_s <= task.end_s);
    BOOST_TEST(task.end_s <= run.makespan_s);
    BOOST_TEST(task.assigned_s >= 0.0);
    BOOST_TEST(task.assigned_s + (task.end_s - task.start_s) <= task.received_s);
    BOOST_TEST(task.received_s <= task.accepted_s);
    BOOST_TEST(task.accepted_s <= run.makespan_s);
    ++tasks[task.rank];
    busy_s[task.rank] += task.end_s - task.start_s;
    if (task.rank == kMasterRank) continue;
    ++results;
    result_bytes += kResultHeaderBytes + task.bytes;
  }
  for (const RankRecord& rank : run.ranks) {
    BOOST_TEST(rank.tasks == tasks[rank.rank]);
    BOOST_CHECK_SMALL(rank.busy_s - busy_s[rank.rank], 1e-9);
    BOOST_CHECK_SMALL(rank.wait_s - (run.makespan_s - rank.busy_s), 1e-9);
    BOOST_TEST(rank.host == run.ranks[0].host);
    BOOST_TEST(!rank.host.empty());
  }
  // Three hellos, stops and goodbyes, all results, at most one assignment per result and return, and what was asked
  // back
  const std::uint64_t greetings = 3 * (kHelloBytes + kSignBytes + kSignBytes);
  BOOST_TEST(run.messages.count >= 3 + 3 + 3 + results);
  BOOST_TEST(run.messages.bytes >= greetings + result_bytes);
  BOOST_TEST((run.faults.silences == 0 && run.faults.reissued == 0 && run.faults.late == 0 && run.faults.damaged == 0));
  BOOST_TEST(run.lost.empty());
}

BOOST_AUTO_TEST_CASE(every_message_is_counted) {
  Plan plan = plan_of(Policy::dynamic, 200);
  plan.ask_back = false;
  const RunRecord run = run_checked(4, 3, plan);
  std::uint64_t results = 0;
  std::uint64_t result_bytes = 0;
  for (const TaskRecord& task : run.tasks) {
    if (task.rank == kMasterRank) continue;
    ++results;
    result_bytes += kResultHeaderBytes + task.bytes;
  }
  BOOST_TEST(run.messages.count <= 3 * 3 + 2 * results);
  const std::uint64_t assigns = run.messages.count - 3 * 3 - results;
  BOOST_TEST(run.messages.bytes == 3 * (kHelloBytes + 2 * kSignBytes) + result_bytes + assigns * kAssignBytes);
}

BOOST_AUTO_TEST_CASE(tasks_asked_back_are_done_once) {
  // With long queues the first rank to run dry asks the others
  std::uint64_t returned = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Plan plan = plan_of(Policy::dynamic, 60);
    plan.prefetch = 20;
    returned += run_checked(4, seed, plan).faults.returned;
  }
  BOOST_TEST(returned > 0U);
}

BOOST_AUTO_TEST_CASE(a_plan_without_tasks_ends_at_once) {
  for (const std::uint32_t ranks : {1U, 4U}) {
    const RunRecord run = run_checked(ranks, 1, plan_of(Policy::dynamic, 0));
    BOOST_TEST(run.tasks.empty());
    BOOST_TEST(run.makespan_s == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(seeds_make_different_histories) {
  std::set<std::vector<Rank>> histories;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    std::vector<Rank> who;
    for (const TaskRecord& task : run_checked(3, seed, plan_of(Policy::self_scheduling, 50)).tasks) {
      who.push_back(task.rank);
    }
    histories.insert(who);
  }
  BOOST_TEST(histories.size() == 10U);
}

BOOST_AUTO_TEST_CASE(what_the_work_throws_comes_out) {
  const Work failing = [](TaskId, const auto&) -> Bytes { throw std::domain_error("no"); };
  for (const std::uint32_t ranks : {1U, 3U}) {
    BOOST_CHECK_THROW(run_in_process(ranks, 0, plan_of(Policy::dynamic, 9), failing, [](TaskId, auto) {}),
                      std::domain_error);
  }
}

// Rank 0 looks up between the slices of a task that never ends, and while it has nothing to do.
BOOST_AUTO_TEST_CASE(what_the_pulse_throws_ends_the_run) {
  const Work endless = [](TaskId, const std::function<void()>& between_slices) -> Bytes {
    while (true) between_slices();
  };
  int beats = 0;
  const Pulse pulse = [&] {
    if (++beats == 100) throw std::domain_error("enough");
  };
  BOOST_CHECK_THROW(run_in_process(
                        1, 0, plan_of(Policy::dynamic, 1), endless, [](TaskId, auto) {}, pulse),
                    std::domain_error);
  beats = 0;
  const Plan idle_master = plan_of(Policy::dynamic, 1'000, MasterRole::dedicated);
  BOOST_CHECK_THROW(run_in_process(
                        2, 0, idle_master, work, [](TaskId, auto) {}, pulse),
                    std::domain_error);
}

BOOST_AUTO_TEST_CASE(what_cannot_work_is_refused) {
  const auto refused = [](std::uint32_t ranks, const Plan& plan) {
    BOOST_CHECK_THROW(run_in_process(ranks, 0, plan, work, [](TaskId, auto) {}), std::invalid_argument);
  };
  refused(1, plan_of(Policy::dynamic, 9, MasterRole::dedicated));
  refused(3, plan_of(Policy::static_bands, 3, MasterRole::dedicated));
  refused(0, plan_of(Policy::dynamic, 9));
}

BOOST_AUTO_TEST_CASE(a_rank_that_breaks_the_protocol_is_named) {
  RunList runs;
  runs.push(TaskId{0});
  const std::vector<Bytes> broken{
      Bytes(3),                                                      // junk
      encode(StopMessage{}),                                         // not for rank 0
      encode(AssignMessage{runs}),                                   // not for rank 0
      encode(BackMessage{1}),                                        // not for rank 0
      encode(ByeMessage{}),                                          // nobody asked for it
      encode(ReturnMessage{runs}),                                   // a task that it does not hold
      encode_whole(ResultMessage{TaskId{7}, 0, 0, {}}, Bytes()),     // a task that it does not hold
      encode_whole(ResultMessage{TaskId{1000}, 0, 0, {}}, Bytes()),  // a task that there is not
  };
  for (const Bytes& message : broken) {
    LoopbackNetwork network(3, 1);
    network.transport(2).send(kMasterRank, Bytes(message));
    const Plan plan = plan_of(Policy::dynamic, 9, MasterRole::dedicated);
    BOOST_CHECK_EXCEPTION(run_master(network.transport(kMasterRank), plan, work, [](TaskId, auto) {}),
                          std::runtime_error,
                          [](const auto& error) { return std::string(error.what()).starts_with("rank 2 sent"); });
  }
}

BOOST_AUTO_TEST_CASE(a_worker_runs_until_it_is_sent_home) {
  LoopbackNetwork network(2, 1);
  network.transport(kMasterRank).send(1, encode(StopMessage{}));
  run_worker(network.transport(1), plan_of(Policy::dynamic, 0), work);
  BOOST_TEST((network.transport(1).sent() == Traffic{2, kHelloBytes + kSignBytes}));
}

BOOST_AUTO_TEST_CASE(no_lease_runs_out_in_process) {
  Plan plan = plan_of(Policy::dynamic, 50);
  plan.lease_s = 1e-9;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const RunRecord run = run_checked(4, seed, plan);
    BOOST_TEST(run.faults.silences == 0U);
    BOOST_TEST(run.lost.empty());
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
