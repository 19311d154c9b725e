// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/worker_run.h"

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "scheduler/by_hand.h"
#include "scheduler/loopback.h"

namespace tessera::scheduler {
namespace {

constexpr double kQuarter = 0.25;
constexpr double kFarTooLongSeconds = 20;

Bytes assignment_of(std::uint32_t first, std::uint32_t count = 1) {
  return encode(AssignMessage{run_of(first, count)});
}

Plan plan_without_tasks() {
  Plan plan;
  plan.lease_s = std::numeric_limits<double>::infinity();
  return plan;
}

// A worker, rank 1 of two, and the mailbox of rank 0.
struct Pair {
  Pair(const Plan& plan, Work work) : worker(network.transport(1), plan, std::move(work)) {
    take<HelloMessage>(master);
  }

  // Steps often enough for all that was sent to have arrived.
  void step_until_idle() {
    for (int idle = 0; idle < 50;) idle = worker.step() == Step::idle ? idle + 1 : 0;
  }

  void step_to_end() {
    for (int step = 0; step < 100000; ++step) {
      if (worker.step() == Step::finished) return;
    }
    BOOST_FAIL("it does not end");
  }

  LoopbackNetwork network{2, 1, Order::as_sent};
  Transport& master = network.transport(kMasterRank);
  WorkerRun worker;
};

Bytes nothing(TaskId, const std::function<void()>&) {
  return {};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(worker_run)

BOOST_AUTO_TEST_CASE(it_says_hello_and_begins_with_what_the_plan_gives_it) {
  Plan plan;
  plan.tasks = 10;
  LoopbackNetwork network(3, 1, Order::as_sent);
  Transport& master = network.transport(kMasterRank);
  WorkerRun worker(network.transport(2), plan, [](TaskId task, const auto&) { return Bytes(index_of(task)); });
  const auto hello = take<HelloMessage>(master);
  BOOST_TEST(hello.pid != 0U);
  BOOST_TEST(!hello.host.empty());
  BOOST_TEST((worker.step() == Step::worked));
  BOOST_TEST((worker.step() == Step::worked));
  BOOST_TEST((worker.step() == Step::idle));
  for (const std::uint32_t task : {2U, 3U}) {
    const Bytes bytes = next_bytes(master).value();
    const auto result = std::get<ResultMessage>(decode(bytes));
    BOOST_TEST(index_of(result.task) == task);
    BOOST_TEST(result.payload.size() == task);
  }
}

BOOST_AUTO_TEST_CASE(a_step_does_one_task) {
  Pair pair(plan_without_tasks(), nothing);
  pair.master.send(1, assignment_of(0, 3));
  while (pair.worker.step() == Step::idle) {
  }
  take<ResultMessage>(pair.master);
  BOOST_TEST(!next_bytes(pair.master).has_value());
}

BOOST_AUTO_TEST_CASE(messages_are_taken_between_the_slices_of_a_task) {
  LoopbackNetwork network(2, 1, Order::as_sent);
  Transport& master = network.transport(kMasterRank);
  std::vector<std::uint32_t> done;
  const Work work = [&](TaskId task, const auto& between_slices) {
    done.push_back(index_of(task));
    if (task == TaskId{0}) {
      master.send(1, assignment_of(1));
      for (int slice = 0; slice < 1000; ++slice) between_slices();
      BOOST_TEST(network.transport(1).received().count == 2U);
    } else {
      master.send(1, encode(StopMessage{}));
    }
    return Bytes();
  };
  master.send(1, assignment_of(0));
  WorkerRun worker(network.transport(1), plan_without_tasks(), work);
  while (worker.step() != Step::finished) {
  }
  BOOST_TEST(done == (std::vector<std::uint32_t>{0, 1}), boost::test_tools::per_element());
  BOOST_TEST(network.transport(1).sent().count == 4U);  // a hello, two results and a goodbye
}

BOOST_AUTO_TEST_CASE(a_stop_ends_it_with_a_goodbye_and_drops_what_is_left) {
  int tasks = 0;
  Pair pair(plan_without_tasks(), [&](TaskId, const auto&) {
    ++tasks;
    return Bytes();
  });
  pair.master.send(1, assignment_of(0, 2));
  pair.step_until_idle();
  pair.master.send(1, encode(StopMessage{}));
  pair.master.send(1, assignment_of(2, 2));
  pair.step_to_end();
  BOOST_TEST(tasks == 2);
  take<ResultMessage>(pair.master);
  take<ResultMessage>(pair.master);
  take<ByeMessage>(pair.master);
  BOOST_TEST(!next_bytes(pair.master).has_value());
}

BOOST_AUTO_TEST_CASE(it_is_sent_home_from_the_middle_of_a_task) {
  bool went_on = false;
  int cleaned_up = 0;
  struct Cleaner {
    int& count;
    ~Cleaner() { ++count; }
  };
  LoopbackNetwork network(2, 1, Order::as_sent);
  Transport& master = network.transport(kMasterRank);
  const Work work = [&](TaskId, const auto& between_slices) {
    const Cleaner cleaner{cleaned_up};
    between_slices();
    master.send(1, encode(StopMessage{}));
    for (int slice = 0; slice < 1000; ++slice) between_slices();
    went_on = true;
    return Bytes(5);
  };
  WorkerRun worker(network.transport(1), plan_without_tasks(), work);
  take<HelloMessage>(master);
  master.send(1, assignment_of(0, 2));
  Step last = worker.step();
  while (last == Step::idle) last = worker.step();
  BOOST_TEST((last == Step::finished));
  BOOST_TEST(!went_on);
  BOOST_TEST(cleaned_up == 1);
  take<ByeMessage>(master);
  BOOST_TEST(!next_bytes(master).has_value());
}

BOOST_AUTO_TEST_CASE(a_long_task_gives_signs_of_life) {
  Plan plan;
  plan.lease_s = 8e-3;
  const Stopwatch since_start;
  LoopbackNetwork network(2, 1, Order::as_sent);
  Transport& own = network.transport(1);
  const Work work = [&](TaskId, const auto& between_slices) {
    while (own.sent().count < 6 && since_start.seconds() < kFarTooLongSeconds) between_slices();
    return Bytes();
  };
  WorkerRun worker(own, plan, work);
  network.transport(kMasterRank).send(1, assignment_of(0));
  while (worker.step() == Step::idle) {
  }
  const double elapsed_s = since_start.seconds();
  Transport& master = network.transport(kMasterRank);
  take<HelloMessage>(master);
  for (int sign = 0; sign < 5; ++sign) take<AliveMessage>(master);
  take<ResultMessage>(master);
  // No more often than is needed
  BOOST_TEST(5 * kQuarter * plan.lease_s <= elapsed_s);
}

BOOST_AUTO_TEST_CASE(signs_are_a_quarter_of_a_lease_apart) {
  Plan plan;
  plan.lease_s = 4e-3;
  const Stopwatch since_start;
  LoopbackNetwork network(2, 1, Order::as_sent);
  const Work work = [&](TaskId, const auto& between_slices) {
    const Stopwatch in_task;
    while (in_task.seconds() < 2.5 * plan.lease_s) between_slices();
    return Bytes();
  };
  WorkerRun worker(network.transport(1), plan, work);
  network.transport(kMasterRank).send(1, assignment_of(0, 3));
  while (worker.step() != Step::idle || network.transport(1).sent().count < 4) {
  }
  const double most = since_start.seconds() / (kQuarter * plan.lease_s);
  BOOST_TEST(static_cast<double>(network.transport(1).sent().count - 4) <= most);
}

BOOST_AUTO_TEST_CASE(who_has_no_task_or_no_lease_gives_no_signs) {
  Plan plan;
  plan.lease_s = 1e-3;
  Pair idle(plan, nothing);
  for (int wait = 0; wait < 5; ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    BOOST_TEST((idle.worker.step() == Step::idle));
  }
  BOOST_TEST(!next_bytes(idle.master).has_value());

  Pair patient(plan_without_tasks(), [](TaskId, const auto& between_slices) {
    for (int slice = 0; slice < 5; ++slice) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      between_slices();
    }
    return Bytes();
  });
  patient.master.send(1, assignment_of(0));
  patient.step_until_idle();
  take<ResultMessage>(patient.master);
  BOOST_TEST(!next_bytes(patient.master).has_value());
}

BOOST_AUTO_TEST_CASE(it_gives_back_what_it_has_not_begun) {
  LoopbackNetwork network(2, 1, Order::as_sent);
  Transport& master = network.transport(kMasterRank);
  std::vector<std::uint32_t> done;
  const Work work = [&](TaskId task, const auto& between_slices) {
    done.push_back(index_of(task));
    if (task == TaskId{0}) {
      master.send(1, encode(BackMessage{2}));
      for (int slice = 0; slice < 1000; ++slice) between_slices();
    }
    return Bytes();
  };
  WorkerRun worker(network.transport(1), plan_without_tasks(), work);
  take<HelloMessage>(master);
  master.send(1, assignment_of(0, 4));
  for (int idle = 0; idle < 50;) idle = worker.step() == Step::idle ? idle + 1 : 0;
  BOOST_TEST((take<ReturnMessage>(master).runs == run_of(2, 2)));
  BOOST_TEST(done == (std::vector<std::uint32_t>{0, 1}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(it_answers_even_if_it_has_nothing_to_give_back) {
  Pair pair(plan_without_tasks(), nothing);
  pair.master.send(1, encode(BackMessage{7}));
  pair.step_until_idle();
  BOOST_TEST(take<ReturnMessage>(pair.master).runs.empty());
  BOOST_TEST(!next_bytes(pair.master).has_value());
}

BOOST_AUTO_TEST_CASE(what_the_work_throws_comes_out) {
  Pair pair(plan_without_tasks(), [](TaskId, const auto&) -> Bytes { throw std::domain_error("no"); });
  pair.master.send(1, assignment_of(0));
  BOOST_CHECK_THROW(pair.step_to_end(), std::domain_error);
}

BOOST_AUTO_TEST_CASE(what_a_master_never_sends_is_refused) {
  Bytes damaged = result_of(1);
  damaged.back() ^= std::byte{1};
  for (const Bytes& message : {Bytes(), Bytes(3), encode(HelloMessage{1, "x"}), result_of(1), damaged,
                               encode(ReturnMessage{run_of(0, 1)}), encode(AliveMessage{}), encode(ByeMessage{})}) {
    Pair pair(plan_without_tasks(), nothing);
    pair.master.send(1, Bytes(message));
    BOOST_CHECK_EXCEPTION(pair.step_to_end(), std::runtime_error,
                          [](const auto& error) { return std::string(error.what()).starts_with("rank 0 sent"); });
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
