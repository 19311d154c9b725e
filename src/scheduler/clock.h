// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

// The one place that times of a run come from, so that they can come from elsewhere: from a simulation, from a test.
namespace tessera::scheduler {

/// Nanoseconds since a moment of the clock's own, which never goes back.
using Clock = std::uint64_t (*)() noexcept;

/// The time now: the system's steady clock's, where no other clock is set.
std::uint64_t now_ns() noexcept;

/// While it lives, `now_ns` asks this clock. Make it before another thread asks; the last one made counts, and they end
/// in reverse order.
class ClockInPlace {
 public:
  explicit ClockInPlace(Clock clock) noexcept;
  ClockInPlace(const ClockInPlace&) = delete;
  ClockInPlace& operator=(const ClockInPlace&) = delete;
  ~ClockInPlace();

 private:
  Clock before_;
};

}  // namespace tessera::scheduler
