// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/worker.h"

#include <algorithm>

namespace tessera::scheduler {

void Worker::assign(const RunList& runs) {
  if (stopped_) return;
  for (const TaskRun& run : runs) {
    if (run.count > 0) queue_.push_back(run);
  }
}

RunList Worker::give_back(std::uint32_t most) {
  RunList given;
  while (most > 0 && !queue_.empty() && given.size() < RunList::kCapacity) {
    TaskRun& last = queue_.back();
    const std::uint32_t count = std::min(most, last.count);
    last.count -= count;
    given.push(TaskRun{TaskId{index_of(last.first) + last.count}, count});
    if (last.count == 0) queue_.pop_back();
    most -= count;
  }
  return given;
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
