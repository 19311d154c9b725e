// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "scheduler/task.h"

// Who has which task. As a rule a task is with one rank; where that one has fallen silent, it is handed out again, and
// the first copy that comes back counts.
namespace tessera::scheduler {

/// What it is worth when a rank delivers a task.
enum class Delivery : std::uint8_t {
  accepted,  ///< it is the first: the task is done
  late,      ///< the rank has the task, but another copy came before
  not_held,  ///< the rank does not have it
};

/// Each task is open, held by one rank, or done; beside that, ranks may have copies of tasks that no longer count on
/// them.
class Ledger {
 public:
  Ledger(std::uint32_t tasks, std::uint32_t ranks);

  std::uint32_t tasks() const noexcept { return static_cast<std::uint32_t>(holder_.size()); }
  std::uint32_t done() const noexcept { return done_; }
  bool is_done(TaskId task) const noexcept { return holder_[index_of(task)] == kDone; }

  /// Tasks and copies that a rank has and has not delivered.
  std::uint32_t held_by(Rank rank) const noexcept { return held_[rank]; }

  /// Gives open tasks to a rank.
  void assign(const TaskRun& run, Rank rank);

  /// A rank delivers a task and has it no longer.
  Delivery deliver(Rank rank, TaskId task);

  /// A rank gives a task up undone. Whether it is open now: not where another rank has it or where it is done.
  /// requires: has(rank, task)
  bool give_up(Rank rank, TaskId task);

  bool has(Rank rank, TaskId task) const { return times_held(rank, task) > 0; }

  /// How often a rank has a task: more than once where it had a copy when the task came to it again.
  std::uint32_t times_held(Rank rank, TaskId task) const;

  /// Opens every task that is held by `rank`, which keeps copies of them, and returns them in ascending order;
  /// O(tasks).
  std::vector<TaskId> reopen_held_by(Rank rank);

  /// Makes `rank` the holder of the open tasks that it has copies of, and returns them.
  std::vector<TaskId> reclaim(Rank rank);

 private:
  // No ranks, but marks in the place of one.
  static constexpr Rank kNobody = ~Rank{0};
  static constexpr Rank kDone = kNobody - 1;

  using Copies = std::unordered_multimap<std::uint32_t, Rank>;
  Copies::const_iterator copy_of(std::uint32_t task, Rank rank) const;

  std::vector<Rank> holder_;         ///< task -> the rank that holds it, or one of two marks
  Copies copies_;                    ///< task -> ranks that have it but are not its holder
  std::vector<std::uint32_t> held_;  ///< per rank
  std::uint32_t done_ = 0;
};

}  // namespace tessera::scheduler
