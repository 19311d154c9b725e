// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/policy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tessera::scheduler {
namespace {

constexpr std::array<std::pair<Policy, std::string_view>, 5> kNames{{
    {Policy::dynamic, "dynamic"},
    {Policy::static_bands, "static-bands"},
    {Policy::cyclic_rows, "cyclic-rows"},
    {Policy::self_scheduling, "self"},
    {Policy::guided, "guided"},
}};

// One task to work on and one to go on with while the result travels.
constexpr std::uint32_t kLeastHeld = 2;
// Bounds what a slow rank can hold on to, and what lies in rank 0's mailbox.
constexpr std::uint32_t kMostHeld = 16;
// A master that renders looks at its mail every 0.1 ms or so. Ten times that keeps a fast worker from running dry.
constexpr double kQueuedWorkSeconds = 1e-3;

constexpr std::uint32_t ceil_div(std::uint32_t a, std::uint32_t b) noexcept {
  return a / b + (a % b != 0);
}

// Tasks whose work, beyond the one in hand, lasts kQueuedWorkSeconds.
std::uint32_t held_to_cover_latency(double mean_task_s) noexcept {
  if (mean_task_s * (kMostHeld - 1) <= kQueuedWorkSeconds) return kMostHeld;
  return std::max(kLeastHeld, 1 + static_cast<std::uint32_t>(std::ceil(kQueuedWorkSeconds / mean_task_s)));
}

// How many tasks a worker should hold when it works a few ahead of its results.
std::uint32_t held_ahead(const Standing& standing) noexcept {
  if (!standing.mean_task_s) return kLeastHeld;
  // Towards the end a deep queue would keep the last tasks from ranks that are idle.
  const std::uint32_t fair = standing.remaining / (2 * standing.ranks);
  return std::min(held_to_cover_latency(*standing.mean_task_s), std::max(kLeastHeld, fair));
}

// A rank that holds this many tasks gets no more.
std::uint32_t target_held(Policy policy, const Standing& standing) noexcept {
  if (standing.rank == kMasterRank) return 1;  // its results do not travel: there is no latency to hide
  if (standing.prefetch) return *standing.prefetch;
  const bool one_at_a_time = policy == Policy::self_scheduling || policy == Policy::guided;
  return one_at_a_time ? 1 : held_ahead(standing);
}

}  // namespace

std::optional<Policy> parse_policy(std::string_view name) noexcept {
  const auto* found =
      std::find_if(kNames.begin(), kNames.end(), [&](const auto& entry) { return entry.second == name; });
  if (found == kNames.end()) return std::nullopt;
  return found->first;
}

std::string_view name_of(Policy policy) noexcept {
  return std::find_if(kNames.begin(), kNames.end(), [&](const auto& entry) { return entry.first == policy; })->second;
}

std::uint32_t tasks_to_assign(Policy policy, const Standing& standing) noexcept {
  const std::uint32_t target = target_held(policy, standing);
  if (standing.held >= target) return 0;
  const bool in_runs = policy == Policy::guided && standing.rank != kMasterRank;
  const std::uint32_t wanted = in_runs ? ceil_div(standing.remaining, standing.ranks) : target - standing.held;
  return std::min(wanted, standing.remaining);
}

}  // namespace tessera::scheduler
