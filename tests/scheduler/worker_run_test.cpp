// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/worker_run.h"

#include <boost/test/unit_test.hpp>
#include <vector>

#include "scheduler/loopback.h"

namespace tessera::scheduler {
namespace {

Bytes assignment_of(TaskId task) {
  RunList runs;
  runs.push(task);
  return encode(AssignMessage{runs});
}

}  // namespace

BOOST_AUTO_TEST_SUITE(worker_run)

BOOST_AUTO_TEST_CASE(messages_are_taken_between_the_slices_of_a_task) {
  LoopbackNetwork network(2, 1);
  Transport& master = network.transport(kMasterRank);
  std::vector<std::uint32_t> done;
  const Work work = [&](TaskId task, const auto& between_slices) {
    done.push_back(index_of(task));
    if (task == TaskId{0}) {
      master.send(1, assignment_of(TaskId{1}));
      for (int slice = 0; slice < 1000; ++slice) between_slices();
      BOOST_TEST(network.transport(1).received().count == 2U);
    } else {
      master.send(1, encode(StopMessage{}));
    }
    return Bytes();
  };
  master.send(1, assignment_of(TaskId{0}));
  WorkerRun worker(network.transport(1), work);
  while (worker.step() != Step::finished) {
  }
  BOOST_TEST(done == (std::vector<std::uint32_t>{0, 1}), boost::test_tools::per_element());
  BOOST_TEST(network.transport(1).sent().count == 3U);  // a hello and two results
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
