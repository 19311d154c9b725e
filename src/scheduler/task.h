// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

// What is scheduled. The scheduler knows a task by its number and, perhaps, by what it is predicted to cost;
// what the task computes is the business of whoever asked for the schedule.
namespace tessera::scheduler {

/// One indivisible piece of work; a plan numbers its tasks 0, 1, 2, ...
enum class TaskId : std::uint32_t {};

constexpr std::uint32_t index_of(TaskId task) noexcept {
  return static_cast<std::uint32_t>(task);
}

/// A process of the job, numbered from 0.
using Rank = std::uint32_t;

/// The rank that hands out tasks and takes results; it may render as well.
inline constexpr Rank kMasterRank = 0;

/// The tasks first, first + 1, ..., first + count - 1.
struct TaskRun {
  TaskId first{};
  std::uint32_t count = 0;

  friend bool operator==(const TaskRun&, const TaskRun&) = default;
};

/// What one assignment can carry: a few runs, so that it has a fixed size on the wire and needs no memory of its own.
class RunList {
 public:
  static constexpr std::size_t kCapacity = 3;

  /// Whether `task` found room. A task that follows the last one lengthens its run and always does.
  constexpr bool push(TaskId task) noexcept {
    if (size_ > 0) {
      TaskRun& last = runs_[size_ - 1];
      if (index_of(task) == index_of(last.first) + last.count) {
        ++last.count;
        return true;
      }
    }
    return push(TaskRun{task, 1});
  }

  constexpr bool push(TaskRun run) noexcept {
    if (size_ == kCapacity) return false;
    runs_[size_++] = run;
    return true;
  }

  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr const TaskRun* begin() const noexcept { return runs_.data(); }
  constexpr const TaskRun* end() const noexcept { return runs_.data() + size_; }

  /// Tasks in all runs together.
  constexpr std::uint32_t tasks() const noexcept {
    std::uint32_t sum = 0;
    for (const TaskRun& run : *this) sum += run.count;
    return sum;
  }

  friend bool operator==(const RunList&, const RunList&) = default;

 private:
  std::array<TaskRun, kCapacity> runs_{};
  std::uint32_t size_ = 0;
};

}  // namespace tessera::scheduler
