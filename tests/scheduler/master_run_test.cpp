// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/master_run.h"

#include <boost/test/unit_test.hpp>
#include <functional>
#include <limits>
#include <vector>

#include "scheduler/by_hand.h"
#include "scheduler/loopback.h"
#include "scheduler/worker_run.h"

namespace tessera::scheduler {
namespace {

constexpr double kFarTooLongSeconds = 20;

Plan plan_with(Policy policy, std::uint32_t tasks, MasterRole role, double lease_s) {
  Plan plan;
  plan.policy = policy;
  plan.tasks = tasks;
  plan.role = role;
  plan.lease_s = lease_s;
  return plan;
}

// Rank 0 for real; the workers are played by the test.
struct Office {
  Office(std::uint32_t ranks, const Plan& plan)
      : network(ranks, 1),
        master(
            network.transport(kMasterRank), plan,
            [](TaskId task, const auto&) { return Bytes(3, static_cast<std::byte>(index_of(task))); },
            [this](TaskId task, std::span<const std::byte> payload) {
              accepted.push_back(index_of(task));
              values.push_back(std::to_integer<int>(payload.front()));
            }) {}

  void send(Rank from, Bytes message) { network.transport(from).send(kMasterRank, std::move(message)); }
  void say_hello(Rank from) { send(from, encode(HelloMessage{4700 + from, "node" + std::to_string(from)})); }

  // Lets rank 0 go on until something is so.
  void step_until(const std::function<bool()>& is_so) {
    const Stopwatch clock;
    while (!is_so()) {
      BOOST_REQUIRE_MESSAGE(clock.seconds() < kFarTooLongSeconds, "it does not come to this");
      is_finished = master.step() == Step::finished;
    }
  }
  void step_to_end() {
    step_until([this] { return is_finished; });
  }

  // Lets rank 0 go on until `rank` gets a message, which must be of this kind.
  template <class Wanted>
  Wanted wait_for(Rank rank) {
    std::optional<Bytes> bytes;
    step_until([&] { return (bytes = next_bytes(network.transport(rank))).has_value(); });
    const Message message = decode(*bytes);
    BOOST_REQUIRE_MESSAGE(std::holds_alternative<Wanted>(message), "it is another message: " << message.index());
    return std::get<Wanted>(message);
  }

  LoopbackNetwork network;
  std::vector<std::uint32_t> accepted;
  std::vector<int> values;
  bool is_finished = false;
  MasterRun master;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(master_run)

BOOST_AUTO_TEST_CASE(workers_are_served_between_the_slices_of_a_long_task_of_rank_0) {
  Plan plan;
  plan.tasks = 50;
  plan.role = MasterRole::rendering;
  LoopbackNetwork network(2, 1);
  const Work short_work = [](TaskId, const auto&) { return Bytes(); };
  WorkerRun worker(network.transport(1), plan, short_work);

  // Rank 0 stays with its first task until the worker has done all the others, or for far too long.
  std::uint32_t accepted = 0;
  std::uint32_t accepted_in_first_task = 0;
  const Work long_work = [&](TaskId, const auto& between_slices) {
    for (int slice = 0; slice < 10000 && accepted + 1 < plan.tasks; ++slice) {
      worker.step();
      between_slices();
    }
    accepted_in_first_task = accepted;
    return Bytes();
  };
  const Accept accept = [&](TaskId, auto) { ++accepted; };
  MasterRun master(network.transport(kMasterRank), plan, long_work, accept);
  master.step();
  BOOST_TEST(accepted_in_first_task == plan.tasks - 1);
  BOOST_TEST(accepted == plan.tasks);
}

BOOST_AUTO_TEST_CASE(a_master_finishes_only_when_every_worker_has_gone_home) {
  const double never = std::numeric_limits<double>::infinity();
  Office office(2, plan_with(Policy::self_scheduling, 2, MasterRole::dedicated, never));
  for (int i = 0; i < 100; ++i) BOOST_TEST((office.master.step() != Step::finished));
  office.say_hello(1);
  office.send(1, result_of(0));
  BOOST_TEST((office.wait_for<AssignMessage>(1).runs == run_of(1, 1)));
  office.send(1, result_of(1));
  office.wait_for<StopMessage>(1);
  for (int i = 0; i < 100; ++i) BOOST_TEST((office.master.step() != Step::finished));
  office.send(1, encode(ByeMessage{}));
  office.step_to_end();
  const RunRecord run = office.master.take_record();
  BOOST_TEST(run.lost.empty());
  BOOST_TEST((run.faults == Faults{}));
}

BOOST_AUTO_TEST_CASE(a_late_result_does_not_reach_accept_and_is_counted_as_wasted) {
  Office office(3, plan_with(Policy::self_scheduling, 500, MasterRole::dedicated, 2e-3));
  // Rank 1 says nothing, so its task 0 comes to rank 2 some time
  std::uint32_t task = 1;
  while (task != 0) {
    office.send(2, result_of(task));
    task = index_of(office.wait_for<AssignMessage>(2).runs.begin()->first);
    office.step_until([&, clock = Stopwatch()] { return clock.seconds() > 0.1e-3; });
  }
  office.send(2, result_of(0, 3, 50));
  office.step_until([&] { return office.accepted.back() == 0; });
  BOOST_TEST(office.values.back() == 50);

  // And then rank 1 does deliver
  const std::size_t before = office.accepted.size();
  office.send(1, result_of(0, 3, 60, 2'000'000));
  office.step_until([&] { return office.network.transport(kMasterRank).received().count == before + 1; });
  BOOST_TEST(office.accepted.size() == before);
  const RunRecord run = office.master.take_record();
  BOOST_TEST(run.faults.silences >= 1U);
  BOOST_TEST(run.faults.late == 1U);
  BOOST_CHECK_CLOSE(run.faults.wasted_s, 2e-3, 1e-9);
  BOOST_TEST(run.tasks[0].rank == 2U);
  BOOST_TEST(run.ranks[1].tasks == 0U);
  BOOST_TEST(run.ranks[1].busy_s == 0.0);
}

BOOST_AUTO_TEST_CASE(a_broken_result_is_done_again) {
  const double never = std::numeric_limits<double>::infinity();
  Office office(2, plan_with(Policy::self_scheduling, 1, MasterRole::dedicated, never));
  for (const std::size_t broken_byte : {kResultHeaderBytes + 1, std::size_t{16}}) {
    Bytes broken = result_of(0, 3, 50);
    broken[broken_byte] ^= std::byte{4};
    office.send(1, broken);
    BOOST_TEST((office.wait_for<AssignMessage>(1).runs == run_of(0, 1)));
    BOOST_TEST(office.accepted.empty());
  }
  office.send(1, result_of(0, 3, 60));
  office.wait_for<StopMessage>(1);
  BOOST_TEST(office.values == (std::vector<int>{60}), boost::test_tools::per_element());
  office.send(1, encode(ByeMessage{}));
  office.step_to_end();
  const RunRecord run = office.master.take_record();
  BOOST_TEST(run.faults.damaged == 2U);
  BOOST_TEST(run.ranks[1].tasks == 1U);
}

BOOST_AUTO_TEST_CASE(rank_0_does_all_where_no_worker_ever_speaks) {
  for (const Policy policy : {Policy::dynamic, Policy::guided, Policy::self_scheduling}) {
    Office office(3, plan_with(policy, 20, MasterRole::dedicated, 3e-3));
    office.step_to_end();
    BOOST_TEST(office.accepted.size() == 20U);
    for (std::size_t i = 0; i < office.accepted.size(); ++i) {
      BOOST_TEST(static_cast<std::uint32_t>(office.values[i]) == office.accepted[i]);
    }
    const RunRecord run = office.master.take_record();
    BOOST_TEST(run.ranks[0].tasks == 20U);
    BOOST_TEST(run.makespan_s > 0.0);
    BOOST_REQUIRE_EQUAL(run.lost.size(), 2U);
    BOOST_TEST(run.lost[0].pid == 0U);
  }
}

BOOST_AUTO_TEST_CASE(who_does_not_go_home_is_lost_with_its_address) {
  Office office(3, plan_with(Policy::self_scheduling, 2, MasterRole::dedicated, 20e-3));
  office.say_hello(1);
  office.say_hello(2);
  office.send(1, result_of(0));
  office.send(2, result_of(1));
  office.step_until([&] { return office.accepted.size() == 2; });
  office.send(1, encode(ByeMessage{}));
  office.step_to_end();
  const RunRecord run = office.master.take_record();
  BOOST_REQUIRE_EQUAL(run.lost.size(), 1U);
  BOOST_TEST(run.lost[0].rank == 2U);
  BOOST_TEST(run.lost[0].host == "node2");
  BOOST_TEST(run.lost[0].pid == 4702U);
  BOOST_TEST(run.ranks[1].host == "node1");
}

BOOST_AUTO_TEST_CASE(who_goes_home_after_it_was_given_up_is_not_lost) {
  Office office(3, plan_with(Policy::self_scheduling, 2, MasterRole::dedicated, 5e-3));
  office.send(1, result_of(0));
  office.send(2, result_of(1));
  office.step_until([&] { return office.accepted.size() == 2; });
  // Rank 2 is on its way, rank 1 was stopped until long after its lease
  const Stopwatch clock;
  while (clock.seconds() < 25e-3) {
    office.send(2, encode(AliveMessage{}));
    BOOST_TEST((office.master.step() != Step::finished));
  }
  office.send(1, encode(ByeMessage{}));
  const auto received = office.network.transport(0).received().count;
  office.step_until([&] {
    office.send(2, encode(AliveMessage{}));
    return office.network.transport(0).received().count > received + 1000;
  });
  office.send(2, encode(ByeMessage{}));
  office.step_to_end();
  BOOST_TEST(office.master.take_record().lost.empty());
}

BOOST_AUTO_TEST_CASE(a_plan_without_tasks_ends_though_a_worker_never_speaks) {
  Office office(2, plan_with(Policy::dynamic, 0, MasterRole::automatic, 3e-3));
  office.step_to_end();
  const RunRecord run = office.master.take_record();
  BOOST_TEST(run.makespan_s == 0.0);
  BOOST_TEST(run.lost.size() == 1U);
}

BOOST_AUTO_TEST_CASE(signs_of_life_keep_a_worker_in_its_place) {
  Office office(2, plan_with(Policy::self_scheduling, 2, MasterRole::dedicated, 5e-3));
  const Stopwatch clock;
  while (clock.seconds() < 20e-3) {
    office.send(1, encode(AliveMessage{}));
    office.master.step();
  }
  BOOST_TEST(office.accepted.empty());
  BOOST_TEST(office.master.take_record().faults.silences == 0U);
}

BOOST_AUTO_TEST_CASE(rank_0_asks_for_tasks_when_it_has_none) {
  const double never = std::numeric_limits<double>::infinity();
  Plan plan = plan_with(Policy::dynamic, 4, MasterRole::rendering, never);
  plan.prefetch = 4;
  Office office(2, plan);
  const std::uint32_t asked = office.wait_for<BackMessage>(1).tasks;
  BOOST_TEST(asked >= 1U);
  BOOST_TEST(asked < 4U);
  office.send(1, encode(ReturnMessage{run_of(3, 1)}));
  office.step_until([&] { return office.accepted.size() == 1; });
  BOOST_TEST(office.accepted[0] == 3U);
  for (const std::uint32_t task : {0U, 1U, 2U}) office.send(1, result_of(task));
  office.send(1, encode(ReturnMessage{}));  // to what rank 0 has asked meanwhile
  office.step_until([&] { return office.accepted.size() == 4; });
  office.send(1, encode(ByeMessage{}));
  office.step_to_end();
  BOOST_TEST(office.master.take_record().faults.returned == 1U);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
