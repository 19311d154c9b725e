// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "scheduler/stopwatch.h"
#include "scheduler/work.h"

namespace tessera::scheduler {

/// A task's result and when it was worked on.
/// units:   nanoseconds on the rank's stopwatch
struct TimedResult {
  Bytes payload;
  std::uint64_t start_ns = 0;
  std::uint64_t busy_ns = 0;  ///< without the time spent on messages between slices
};

/// Does tasks one after the other, sees to the rank's messages in between their slices, and keeps the two times apart.
class TimedWork {
 public:
  /// `clock` must outlive this; `serve` is called from within a task, but never from within itself. What it throws ends
  /// the task.
  TimedWork(Work work, const Stopwatch& clock, std::function<void()> serve);
  TimedWork(const TimedWork&) = delete;
  TimedWork& operator=(const TimedWork&) = delete;

  TimedResult run(TaskId task);

 private:
  void pause();

  Work work_;
  const Stopwatch& clock_;
  std::function<void()> serve_;
  std::function<void()> between_slices_;
  bool serving_ = false;
  std::uint64_t paused_ns_ = 0;
};

}  // namespace tessera::scheduler
