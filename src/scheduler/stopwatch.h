// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>

namespace tessera::scheduler {

constexpr double seconds_from_ns(std::uint64_t ns) noexcept {
  return static_cast<double>(ns) * 1e-9;
}

/// Time since it was made, on a clock that never goes back.
class Stopwatch {
 public:
  std::uint64_t elapsed_ns() const noexcept {
    return static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - start_).count());
  }
  double seconds() const noexcept { return seconds_from_ns(elapsed_ns()); }

  /// How much later than `other`, of the same process, it was made; negative where it was earlier.
  double seconds_after(const Stopwatch& other) const noexcept {
    return std::chrono::duration<double>(start_ - other.start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tessera::scheduler
