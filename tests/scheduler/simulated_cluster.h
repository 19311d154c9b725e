// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scheduler/plan.h"

// A cluster that exists in numbers alone: the real master and policies drive simulated ranks, whose tasks take the time
// that the caller says, over simulated wires. No clock and no chance: the same input gives the same schedule.
namespace tessera::scheduler {

/// units:   seconds
struct Cluster {
  std::uint32_t ranks = 2;
  double one_way_s = 1e-6;             ///< a message is so long on the wire
  double master_per_message_s = 3e-6;  ///< rank 0 takes so long for a message that comes in, its answer included
  double slice_s = 1e-4;               ///< a rank 0 that renders looks at its mail after so much of its own task
};

/// units:   seconds
struct SimulatedRun {
  double makespan_s = 0;  ///< to the last acceptance
  double busy_s = 0;      ///< of all ranks together
  double efficiency = 0;  ///< busy / (ranks * makespan)
  double imbalance = 0;   ///< longest busy time of a rank / mean - 1
  double tail_s = 0;      ///< first rank idle for good -> last acceptance; a master that rendered nothing left out
  std::uint64_t messages = 0;
};

/// Carries out `plan` where task i takes task_s[i], whatever the plan predicts.
/// shapes:  task_s holds one value per task
/// throws:  std::invalid_argument where the plan is not feasible
SimulatedRun simulate(const Cluster& cluster, const Plan& plan, const std::vector<double>& task_s);

}  // namespace tessera::scheduler
