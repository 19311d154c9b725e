// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/backoff.h"

#include <algorithm>
#include <thread>

namespace tessera::scheduler {
namespace {

using std::chrono::microseconds;

constexpr microseconds kSpin{20};
constexpr microseconds kYield{300};  // longer than the shortest sleep takes, 100 us and more with what the system adds
constexpr microseconds kYieldToOthers{100};
constexpr microseconds kShortestSleep{50};
constexpr microseconds kLongestSleep{1000};
constexpr int kWaitedPerSleep = 20;

}  // namespace

void Backoff::wait() {
  const Clock::time_point now = Clock::now();
  if (!idle_) {
    idle_ = true;
    since_ = now;
  }
  const auto waited = std::chrono::duration_cast<microseconds>(now - since_);
  if (patience_ == Patience::spin_first && waited < kSpin) return;
  if (waited < (patience_ == Patience::spin_first ? kYield : kYieldToOthers)) {
    std::this_thread::yield();
  } else {
    std::this_thread::sleep_for(std::clamp(waited / kWaitedPerSleep, kShortestSleep, kLongestSleep));
  }
}

}  // namespace tessera::scheduler
