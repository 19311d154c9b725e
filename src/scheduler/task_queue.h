// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "scheduler/plan.h"
#include "scheduler/policy.h"
#include "scheduler/task.h"

// The tasks that nobody has yet, in the order in which they are handed out.
namespace tessera::scheduler {

/// Each task comes out once, and again for each time that it is put back. Owned tasks come out in ascending order, each
/// to its owner; the others in ascending order or, where the plan predicts costs and its policy hands out single tasks,
/// dearest first. What was put back comes first, to whoever asks.
class TaskQueue {
 public:
  TaskQueue(const Plan& plan, std::uint32_t ranks);

  /// Tasks that `rank` can still get.
  std::uint32_t remaining(Rank rank) const noexcept;

  /// The same with what there was at the start, and in predicted seconds where the plan has costs.
  Backlog backlog(Rank rank) const noexcept;

  /// Takes a share for `rank`, at least a task where it is not empty; less where tasks run out or lie in more runs than
  /// a list holds.
  RunList take(Rank rank, const Share& share);

  /// Takes a task in again that somebody took and did not do.
  void put_back(TaskId task) { returned_.push_back(task); }

  bool has_returned() const noexcept { return !returned_.empty(); }

  /// The tasks that `rank` owns and nobody had yet become everybody's, as if they had been put back.
  void disown(Rank rank);

  /// Forgets a task that was put back, if it is still here: it is done after all.
  void withdraw(TaskId task);

 private:
  /// Tasks that `rank` can get and nobody had yet.
  std::uint32_t untouched(Rank rank) const noexcept;

  std::uint32_t& cursor_of(Rank rank) noexcept { return cursors_[cursors_.size() == 1 ? 0 : rank]; }
  std::uint32_t cursor_of(Rank rank) const noexcept { return cursors_[cursors_.size() == 1 ? 0 : rank]; }

  std::uint32_t tasks_;
  std::uint32_t stride_;                ///< from one task of a rank to the next: 1, or P where tasks are owned
  std::vector<std::uint32_t> cursors_;  ///< next position, one per owner or one for all
  std::vector<TaskId> order_;           ///< position -> task, empty where they are the same
  std::deque<TaskId> returned_;
  std::vector<double> left_s_;  ///< position -> predicted work from there to the end, empty without costs
};

}  // namespace tessera::scheduler
