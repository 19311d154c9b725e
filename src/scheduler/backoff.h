// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>

// What a rank does while it has nothing to do.
namespace tessera::scheduler {

/// How long waiting may keep the core to itself.
enum class Patience : std::uint8_t {
  spin_first,  ///< the core is the rank's own: spin for 20 us, for most answers come sooner than a sleep would end
  yield_only,  ///< others need the core
};

/// Successive waits give way more and more: spin, yield, then sleep for a twentieth of the time waited so far, between
/// 50 us and 1 ms. So what ends a long wait is noticed at most 5 % late, and an idle rank leaves its core alone. Ranks
/// that have their cores yield for so long that two who answer each other do not fall asleep in turn. Call `wait` after
/// every look that found nothing, `reset` after one that found something.
class Backoff {
 public:
  explicit Backoff(Patience patience) noexcept : patience_(patience) {}

  void wait();
  void reset() noexcept { idle_ = false; }

 private:
  using Clock = std::chrono::steady_clock;

  Patience patience_;
  bool idle_ = false;
  Clock::time_point since_{};
};

}  // namespace tessera::scheduler
