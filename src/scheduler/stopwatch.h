// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "scheduler/clock.h"

namespace tessera::scheduler {

constexpr double seconds_from_ns(std::uint64_t ns) noexcept {
  return static_cast<double>(ns) * 1e-9;
}

/// Time since it was made, on the clock that `now_ns` asks.
class Stopwatch {
 public:
  std::uint64_t elapsed_ns() const noexcept { return now_ns() - start_ns_; }
  double seconds() const noexcept { return seconds_from_ns(elapsed_ns()); }

  /// How much later than `other`, of the same process, it was made; negative where it was earlier.
  double seconds_after(const Stopwatch& other) const noexcept {
    return start_ns_ >= other.start_ns_ ? seconds_from_ns(start_ns_ - other.start_ns_)
                                        : -seconds_from_ns(other.start_ns_ - start_ns_);
  }

 private:
  std::uint64_t start_ns_ = now_ns();
};

}  // namespace tessera::scheduler
