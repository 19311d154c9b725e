// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/worker.h"

#include <boost/test/unit_test.hpp>
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

BOOST_AUTO_TEST_CASE(a_stopped_worker_drops_its_queue_and_takes_nothing_more) {
  Worker worker;
  worker.assign(runs_of({{TaskId{1}, 4}}));
  worker.stop();
  BOOST_TEST(worker.is_stopped());
  BOOST_TEST(!worker.next().has_value());
  worker.assign(runs_of({{TaskId{1}, 4}}));
  BOOST_TEST(!worker.next().has_value());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
