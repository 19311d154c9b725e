// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/timed_work.h"

#include <utility>

namespace tessera::scheduler {

TimedWork::TimedWork(Work work, const Stopwatch& clock, std::function<void()> serve)
    : work_(std::move(work)), clock_(clock), serve_(std::move(serve)), between_slices_([this] { pause(); }) {}

TimedResult TimedWork::run(TaskId task) {
  paused_ns_ = 0;
  TimedResult result;
  result.start_ns = clock_.elapsed_ns();
  result.payload = work_(task, between_slices_);
  result.busy_ns = clock_.elapsed_ns() - result.start_ns - paused_ns_;
  return result;
}

void TimedWork::pause() {
  if (serving_) return;
  serving_ = true;
  const std::uint64_t begin_ns = clock_.elapsed_ns();
  try {
    serve_();
  } catch (...) {
    serving_ = false;
    throw;
  }
  paused_ns_ += clock_.elapsed_ns() - begin_ns;
  serving_ = false;
}

}  // namespace tessera::scheduler
