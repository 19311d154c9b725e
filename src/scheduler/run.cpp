// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/run.h"

#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include "scheduler/loopback.h"
#include "scheduler/master_run.h"
#include "scheduler/stepper.h"
#include "scheduler/worker_run.h"

namespace tessera::scheduler {
namespace {

// So many steps in a row find nothing only if nothing will ever come: a message is held back with probability 1/4.
constexpr std::uint64_t kIdleStepsPerRank = 1000;

/// Rank 0's work with the caller's pulse between its slices.
Work with_pulse(const Work& work, const Pulse& pulse) {
  return [&](TaskId task, const std::function<void()>& between_slices) {
    return work(task, [&] {
      pulse();
      between_slices();
    });
  };
}

/// The same between the steps.
struct PulsedMaster {
  MasterRun& master;
  const Pulse& pulse;

  Step step() {
    pulse();
    return master.step();
  }
};

}  // namespace

RunRecord run_master(Transport& transport, const Plan& plan, const Work& work, const Accept& accept, const Pulse& pulse,
                     const Stopwatch& clock) {
  MasterRun master(transport, plan, with_pulse(work, pulse), accept, clock);
  PulsedMaster pulsed{master, pulse};
  run_to_end(pulsed, transport);
  return master.take_record();
}

void run_worker(Transport& transport, const Plan& plan, const Work& work, const Stopwatch& clock) {
  WorkerRun worker(transport, plan, work, clock);
  run_to_end(worker, transport);
}

RunRecord run_in_process(std::uint32_t ranks, std::uint64_t seed, const Plan& plan, const Work& work,
                         const Accept& accept, const Pulse& pulse) {
  require_feasible(plan, ranks);
  Plan patient = plan;
  patient.lease_s = std::numeric_limits<double>::infinity();
  std::mt19937_64 random(seed);
  LoopbackNetwork network(ranks, random());  // a seed of its own, or deliveries would follow the steps
  MasterRun master(network.transport(kMasterRank), patient, with_pulse(work, pulse), accept);
  PulsedMaster pulsed{master, pulse};
  std::vector<std::unique_ptr<WorkerRun>> workers;
  for (Rank rank = 1; rank < ranks; ++rank) {
    workers.push_back(std::make_unique<WorkerRun>(network.transport(rank), patient, work));
  }

  std::vector<Rank> unfinished(ranks);
  for (Rank rank = 0; rank < ranks; ++rank) unfinished[rank] = rank;
  std::uint64_t idle_steps = 0;
  while (!unfinished.empty()) {
    const std::size_t chosen = random() % unfinished.size();
    const Rank rank = unfinished[chosen];
    const Step step = rank == kMasterRank ? pulsed.step() : workers[rank - 1]->step();
    idle_steps = step == Step::idle ? idle_steps + 1 : 0;
    if (idle_steps > kIdleStepsPerRank * ranks) throw std::logic_error("every rank waits for another one");
    if (step != Step::finished) continue;
    unfinished[chosen] = unfinished.back();
    unfinished.pop_back();
  }
  return master.take_record();
}

}  // namespace tessera::scheduler
