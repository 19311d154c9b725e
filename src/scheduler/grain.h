// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "scheduler/task.h"

// How much work a task should hold, where that can be chosen: little enough that the last ones to finish are not waited
// for, and enough that rank 0 keeps up with handing them out.
namespace tessera::scheduler {

/// Rank 0's time per task.
/// units:   seconds
inline constexpr double kMasterSecondsPerTask = 3e-6;

/// The least work that is worth a task where `work_s` is all there is. While a rank is at it, rank 0 serves all the
/// others three times over; where that would leave too few tasks to balance with, both evils are the same: a rank gets
/// n = work_s / (ranks least_task_s) tasks, waits for the last one 1/n of its time, and rank 0 takes n ranks o.
/// units:   seconds
inline double least_task_s(double work_s, Rank ranks) noexcept {
  return std::min(std::max(100e-6, 3 * ranks * kMasterSecondsPerTask), std::sqrt(work_s * kMasterSecondsPerTask));
}

/// The most work that the next task should hold while `remaining_s` of `work_s` is left: a quarter of a rank's share of
/// the rest. So tasks shrink towards the end, and what is predicted wrong at the start can still be made good.
/// units:   seconds
inline double largest_task_s(double remaining_s, double work_s, Rank ranks) noexcept {
  return std::max(least_task_s(work_s, ranks), remaining_s / (4.0 * ranks));
}

/// x = W / (P^2 o): how often rank 0 could hand out a rank's share of the work while the rank is at it. It decides
/// nearly everything: below 1, handing out is all that happens.
inline double work_ratio(double work_s, Rank ranks) noexcept {
  return work_s / (static_cast<double>(ranks) * ranks * kMasterSecondsPerTask);
}

}  // namespace tessera::scheduler
