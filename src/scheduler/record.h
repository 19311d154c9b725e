// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scheduler/bytes.h"
#include "scheduler/task.h"

// What happened in a run, for statistics, traces and pictures of the schedule.
namespace tessera::scheduler {

/// units:   seconds since the rank began its render phase
struct TaskRecord {
  TaskId task{};
  Rank rank = 0;
  double start_s = 0;
  double end_s = 0;  ///< start plus the time spent on the task, without messages served in between
  std::size_t bytes = 0;
};

/// units:   seconds
struct RankRecord {
  Rank rank = 0;
  std::string host;
  std::uint32_t tasks = 0;
  double busy_s = 0;
  double wait_s = 0;  ///< makespan - busy
};

/// shapes:  tasks[i] is of task i, ranks[r] of rank r
/// units:   seconds
struct RunRecord {
  double makespan_s = 0;  ///< start of the render phase on rank 0 -> last result accepted
  std::vector<TaskRecord> tasks;
  std::vector<RankRecord> ranks;
  Traffic messages;  ///< sent and received by rank 0
};

}  // namespace tessera::scheduler
