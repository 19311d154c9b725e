// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/worker.h"

namespace tessera::scheduler {

void Worker::assign(const RunList& runs) {
  if (stopped_) return;
  for (const TaskRun& run : runs) {
    if (run.count > 0) queue_.push_back(run);
  }
}

void Worker::stop() noexcept {
  stopped_ = true;
  queue_.clear();
}

std::optional<TaskId> Worker::next() noexcept {
  if (queue_.empty()) return std::nullopt;
  TaskRun& run = queue_.front();
  const TaskId task = run.first;
  run.first = TaskId{index_of(task) + 1};
  if (--run.count == 0) queue_.pop_front();
  return task;
}

}  // namespace tessera::scheduler
