// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scheduler/bytes.h"
#include "scheduler/stopwatch.h"
#include "scheduler/task.h"

// What happened in a run, for statistics, traces and pictures of the schedule.
namespace tessera::scheduler {

/// units:   seconds since the rank began its render phase: rank 0 for what it assigns, receives and accepts
struct TaskRecord {
  TaskId task{};
  Rank rank = 0;
  double start_s = 0;
  double end_s = 0;  ///< start plus the time spent on the task, without messages served in between
  std::size_t bytes = 0;
  double assigned_s = 0;  ///< rank 0 is about to hand it to this rank; 0: the rank began with it
  double received_s = 0;  ///< rank 0 has the result
  double accepted_s = 0;  ///< the result is in its place
};

/// units:   seconds
struct RankRecord {
  Rank rank = 0;
  std::string host;
  std::uint32_t tasks = 0;
  double busy_s = 0;
  double wait_s = 0;               ///< makespan - busy
  double clock_offset_s = 0;       ///< added to the rank's own times it gives rank 0's; 0 where nobody measured
  double clock_uncertainty_s = 0;  ///< how far off that may be
};

/// What went wrong on the way and was made good.
struct Faults {
  std::uint64_t silences = 0;  ///< times that a rank with tasks was not heard of for a lease
  std::uint64_t reissued = 0;  ///< tasks handed out again because of that, or because a result was broken
  std::uint64_t damaged = 0;   ///< results that arrived broken
  std::uint64_t late = 0;      ///< results whose task another rank had delivered before
  std::uint64_t returned = 0;  ///< tasks that a rank gave back for an idle one
  double wasted_s = 0;         ///< spent on late results

  friend bool operator==(const Faults&, const Faults&) = default;
};

/// A rank that did not come to the end, and where its process may still hang.
struct LostRank {
  Rank rank = 0;
  std::string host;
  std::uint32_t pid = 0;  ///< 0: it never said
};

/// shapes:  tasks[i] is of task i, ranks[r] of rank r
/// units:   seconds
struct RunRecord {
  double makespan_s = 0;  ///< start of the render phase on rank 0 -> last result accepted
  std::vector<TaskRecord> tasks;
  std::vector<RankRecord> ranks;
  Traffic messages;  ///< sent and received by rank 0
  Faults faults;
  std::vector<LostRank> lost;
  Stopwatch clock;  ///< rank 0's, whose times these are
};

}  // namespace tessera::scheduler
