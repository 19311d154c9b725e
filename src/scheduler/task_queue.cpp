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

/// Sums from each position to the end, and a 0 behind the last.
std::vector<double> work_left(const std::vector<double>& costs, const std::vector<TaskId>& order) {
  std::vector<double> left_s(costs.size() + 1);
  for (std::size_t i = costs.size(); i-- > 0;)
    left_s[i] = left_s[i + 1] + costs[order.empty() ? i : index_of(order[i])];
  return left_s;
}

}  // namespace

TaskQueue::TaskQueue(const Plan& plan, std::uint32_t ranks)
    : tasks_(plan.tasks), stride_(has_owners(plan.policy) ? ranks : 1), cursors_(stride_) {
  std::iota(cursors_.begin(), cursors_.end(), 0U);
  if (plan.policy == Policy::dynamic || plan.policy == Policy::self_scheduling) order_ = dearest_first(plan.costs);
  if (!has_owners(plan.policy) && !plan.costs.empty()) left_s_ = work_left(plan.costs, order_);
}

std::uint32_t TaskQueue::remaining(Rank rank) const noexcept {
  const auto returned = static_cast<std::uint32_t>(returned_.size());
  return returned + untouched(rank);
}

std::uint32_t TaskQueue::untouched(Rank rank) const noexcept {
  const std::uint32_t next = cursor_of(rank);
  return next >= tasks_ ? 0 : (tasks_ - next - 1) / stride_ + 1;
}

Backlog TaskQueue::backlog(Rank rank) const noexcept {
  const std::uint32_t first = stride_ == 1 ? 0 : rank;
  Backlog backlog;
  backlog.tasks = first >= tasks_ ? 0 : (tasks_ - first - 1) / stride_ + 1;
  backlog.remaining = remaining(rank);
  if (left_s_.empty()) return backlog;
  const std::uint32_t next = cursor_of(rank);
  backlog.tasks_s = left_s_.front();
  backlog.remaining_s = left_s_[next];
  if (untouched(rank) > 0) backlog.next_s = left_s_[next] - left_s_[next + 1];
  return backlog;
}

RunList TaskQueue::take(Rank rank, const Share& share) {
  RunList runs;
  std::uint32_t most = share.tasks;
  for (; most > 0 && !returned_.empty(); --most) {
    if (!runs.push(returned_.front())) return runs;
    returned_.pop_front();
    if (share.seconds) return runs;
  }
  std::uint32_t& next = cursor_of(rank);
  const bool is_measured = share.seconds && !left_s_.empty();
  const double enough_s = is_measured ? left_s_[next] - *share.seconds : 0;
  for (std::uint32_t left = std::min(most, untouched(rank)); left > 0; --left) {
    if (!runs.push(order_.empty() ? TaskId{next} : order_[next])) break;
    next += stride_;
    if (is_measured && left_s_[next] <= enough_s) break;
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
