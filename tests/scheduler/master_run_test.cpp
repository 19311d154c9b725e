// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/master_run.h"

#include <boost/test/unit_test.hpp>

#include "scheduler/loopback.h"
#include "scheduler/worker_run.h"

namespace tessera::scheduler {

BOOST_AUTO_TEST_SUITE(master_run)

BOOST_AUTO_TEST_CASE(workers_are_served_between_the_slices_of_a_long_task_of_rank_0) {
  Plan plan;
  plan.tasks = 50;
  plan.role = MasterRole::rendering;
  LoopbackNetwork network(2, 1);
  const Work short_work = [](TaskId, const auto&) { return Bytes(); };
  WorkerRun worker(network.transport(1), short_work);

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

BOOST_AUTO_TEST_CASE(a_master_finishes_only_when_every_worker_is_sent_home) {
  Plan plan;
  plan.tasks = 3;
  LoopbackNetwork network(2, 1);
  const Work work = [](TaskId, const auto&) { return Bytes(); };
  MasterRun master(network.transport(kMasterRank), plan, work, [](TaskId, auto) {});
  for (int i = 0; i < 100; ++i) BOOST_TEST((master.step() != Step::finished));
  WorkerRun late(network.transport(1), work);
  while (master.step() != Step::finished) {
  }
  while (late.step() != Step::finished) {
  }
  const RunRecord run = master.take_record();
  BOOST_TEST(run.ranks.at(0).tasks == 3U);
  BOOST_TEST((run.messages == Traffic{2, kHelloBytes + kStopBytes}));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
