// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/task_queue.h"

#include <algorithm>
#include <numeric>

namespace tessera::scheduler {
namespace {

std::vector<TaskId> dearest_first(const std::vector<double>& costs) {
  std::vector<TaskId> order(costs.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = TaskId{i};
  std::stable_sort(order.begin(), order.end(),
                   [&](TaskId a, TaskId b) { return costs[index_of(a)] > costs[index_of(b)]; });
  return order;
}

}  // namespace

TaskQueue::TaskQueue(const Plan& plan, std::uint32_t ranks)
    : tasks_(plan.tasks), stride_(has_owners(plan.policy) ? ranks : 1), cursors_(stride_) {
  std::iota(cursors_.begin(), cursors_.end(), 0U);
  if (plan.policy == Policy::dynamic || plan.policy == Policy::self_scheduling) order_ = dearest_first(plan.costs);
}

std::uint32_t TaskQueue::remaining(Rank rank) const noexcept {
  const auto returned = static_cast<std::uint32_t>(returned_.size());
  return returned + untouched(rank);
}

std::uint32_t TaskQueue::untouched(Rank rank) const noexcept {
  const std::uint32_t next = cursor_of(rank);
  return next >= tasks_ ? 0 : (tasks_ - next - 1) / stride_ + 1;
}

RunList TaskQueue::take(Rank rank, std::uint32_t most) {
  RunList runs;
  for (; most > 0 && !returned_.empty(); --most) {
    if (!runs.push(returned_.front())) return runs;
    returned_.pop_front();
  }
  std::uint32_t& next = cursor_of(rank);
  for (std::uint32_t left = std::min(most, untouched(rank)); left > 0; --left) {
    if (!runs.push(order_.empty() ? TaskId{next} : order_[next])) break;
    next += stride_;
  }
  return runs;
}

void TaskQueue::disown(Rank rank) {
  if (cursors_.size() == 1) return;  // they are everybody's already
  for (std::uint32_t& next = cursor_of(rank); next < tasks_; next += stride_) put_back(TaskId{next});
}

void TaskQueue::withdraw(TaskId task) {
  std::erase(returned_, task);
}

}  // namespace tessera::scheduler
