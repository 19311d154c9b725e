// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "scheduler/task.h"

// A worker's side of the schedule: it renders what it is given, in that order, until it is sent home.
namespace tessera::scheduler {

class Worker {
 public:
  /// Takes tasks to do after those it has. A stopped worker takes none.
  void assign(const RunList& runs);

  /// Gives up to `most` tasks back: those that it would do last, as far as they fit into a list.
  RunList give_back(std::uint32_t most);

  /// Ends the work; what is still queued is dropped.
  void stop() noexcept;

  /// The task to do now, which leaves the queue, or nullopt where there is none.
  std::optional<TaskId> next() noexcept;

  bool is_stopped() const noexcept { return stopped_; }

 private:
  std::deque<TaskRun> queue_;  ///< no run is empty
  bool stopped_ = false;
};

}  // namespace tessera::scheduler
