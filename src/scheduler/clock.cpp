// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/clock.h"

#include <chrono>
#include <utility>

namespace tessera::scheduler {
namespace {

std::uint64_t steady_ns() noexcept {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(since_start).count());
}

Clock clock_in_use = steady_ns;

}  // namespace

std::uint64_t now_ns() noexcept {
  return clock_in_use();
}

ClockInPlace::ClockInPlace(Clock clock) noexcept : before_(std::exchange(clock_in_use, clock)) {}

ClockInPlace::~ClockInPlace() {
  clock_in_use = before_;
}

}  // namespace tessera::scheduler
