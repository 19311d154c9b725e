// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/worker.h"

#include <boost/test/unit_test.hpp>
#include <random>
#include <vector>

namespace tessera::scheduler {
namespace {

RunList runs_of(std::vector<TaskRun> runs) {
  RunList list;
  for (const TaskRun& run : runs) list.push(run);
  return list;
}

std::vector<std::uint32_t> take_all(Worker& worker) {
  std::vector<std::uint32_t> taken;
  while (const auto task = worker.next()) taken.push_back(index_of(*task));
  return taken;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(worker)

BOOST_AUTO_TEST_CASE(a_new_worker_has_nothing_to_do) {
  Worker worker;
  BOOST_TEST(!worker.next().has_value());
  BOOST_TEST(!worker.is_stopped());
}

BOOST_AUTO_TEST_CASE(tasks_are_done_in_the_order_of_assignment) {
  Worker worker;
  worker.assign(runs_of({{TaskId{7}, 2}, {TaskId{3}, 1}}));
  BOOST_TEST(index_of(worker.next().value()) == 7U);
  worker.assign(runs_of({{TaskId{0}, 3}}));
  BOOST_TEST(take_all(worker) == (std::vector<std::uint32_t>{8, 3, 0, 1, 2}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_last_task_number_can_be_done) {
  Worker worker;
  worker.assign(runs_of({{TaskId{0xfffffffe}, 2}}));
  BOOST_TEST(take_all(worker) == (std::vector<std::uint32_t>{0xfffffffe, 0xffffffff}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_would_be_done_last_is_given_back) {
  Worker worker;
  worker.assign(runs_of({{TaskId{10}, 4}, {TaskId{3}, 2}}));
  worker.next();
  BOOST_TEST((worker.give_back(3) == runs_of({{TaskId{3}, 2}, {TaskId{13}, 1}})));
  BOOST_TEST(take_all(worker) == (std::vector<std::uint32_t>{11, 12}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(no_more_is_given_back_than_is_asked_for_or_there) {
  Worker worker;
  BOOST_TEST(worker.give_back(5).empty());
  worker.assign(runs_of({{TaskId{7}, 3}}));
  BOOST_TEST(worker.give_back(0).empty());
  BOOST_TEST((worker.give_back(1) == runs_of({{TaskId{9}, 1}})));
  BOOST_TEST((worker.give_back(0xffffffff) == runs_of({{TaskId{7}, 2}})));
  BOOST_TEST(!worker.next().has_value());
  BOOST_TEST(worker.give_back(1).empty());
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_into_a_list_is_kept) {
  Worker worker;
  worker.assign(runs_of({{TaskId{0}, 1}, {TaskId{2}, 1}}));
  worker.assign(runs_of({{TaskId{4}, 5}, {TaskId{20}, 1}}));
  BOOST_TEST((worker.give_back(8) == runs_of({{TaskId{20}, 1}, {TaskId{4}, 5}, {TaskId{2}, 1}})));
  BOOST_TEST(take_all(worker) == (std::vector<std::uint32_t>{0}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_was_given_back_can_come_again) {
  Worker worker;
  worker.assign(runs_of({{TaskId{0}, 2}}));
  worker.assign(worker.give_back(2));
  BOOST_TEST(take_all(worker) == (std::vector<std::uint32_t>{0, 1}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(given_back_and_done_are_together_what_was_assigned) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    std::mt19937_64 random(seed);
    Worker worker;
    std::vector<int> times(200, 0);
    std::uint32_t next_task = 0;
    for (int step = 0; step < 60; ++step) {
      const auto count = static_cast<std::uint32_t>(1 + random() % 6);
      if (random() % 3 == 0 && next_task + count < times.size()) {
        worker.assign(runs_of({{TaskId{next_task}, count}}));
        next_task += count;
      } else if (random() % 2 == 0) {
        const RunList given = worker.give_back(count);
        BOOST_TEST(given.tasks() <= count);
        for (const TaskRun& run : given) {
          for (std::uint32_t i = 0; i < run.count; ++i) ++times.at(index_of(run.first) + i);
        }
      } else if (const auto task = worker.next()) {
        ++times.at(index_of(*task));
      }
    }
    for (const std::uint32_t task : take_all(worker)) ++times.at(task);
    for (std::uint32_t task = 0; task < times.size(); ++task) BOOST_TEST(times[task] == (task < next_task ? 1 : 0));
  }
}

BOOST_AUTO_TEST_CASE(a_stopped_worker_drops_its_queue_and_takes_nothing_more) {
  Worker worker;
  worker.assign(runs_of({{TaskId{1}, 4}}));
  worker.stop();
  BOOST_TEST(worker.is_stopped());
  BOOST_TEST(!worker.next().has_value());
  worker.assign(runs_of({{TaskId{1}, 4}}));
  BOOST_TEST(!worker.next().has_value());
  BOOST_TEST(worker.give_back(4).empty());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
