// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "scheduler/record.h"

// How well the work was shared, over the render phase, rank 0 counted, and what sharing it took.
namespace tessera::scheduler {

/// Every value is 0 where it has no meaning: no ranks, or no time spent.
struct Balance {
  double imbalance = 0;       ///< max busy / mean busy - 1
  double load_balance = 0;    ///< mean busy / max busy
  double efficiency = 0;      ///< sum of busy / (ranks * makespan)
  double tail_s = 0;          ///< first rank idle for good -> last result; a master that rendered nothing left out
  double graham_bound_s = 0;  ///< no list schedule without latency takes longer: W/P + (1 - 1/P) t_max
  double makespan_s = 0;
};

/// units:   seconds
/// source:  graham_bound_s: Graham, Bounds on multiprocessing timing anomalies, SIAM J. Appl. Math. 17(2) (1969)
Balance balance_of(const RunRecord& run);

/// What handing out tasks took. Every value is 0 where it has no meaning: no tasks, or none that travelled.
struct Overhead {
  double messages_per_task = 0;  ///< sent and received by rank 0, over all tasks
  double bytes_per_task = 0;
  double master_s_per_task = 0;  ///< rank 0's time from having a result to having it in its place, the answer included
  std::uint32_t most_held = 0;   ///< tasks that one worker had at the same time and had not delivered
  double mean_held = 0;          ///< the same on average, while the worker had any
};

/// units:   seconds
Overhead overhead_of(const RunRecord& run);

}  // namespace tessera::scheduler
