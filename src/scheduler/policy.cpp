// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/policy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scheduler/chunk.h"
#include "scheduler/grain.h"

namespace tessera::scheduler {
namespace {

constexpr std::array<std::pair<Policy, std::string_view>, 7> kNames{{
    {Policy::dynamic, "dynamic"},
    {Policy::static_bands, "static-bands"},
    {Policy::cyclic_rows, "cyclic-rows"},
    {Policy::self_scheduling, "self"},
    {Policy::guided, "guided"},
    {Policy::factoring, "factoring"},
    {Policy::trapezoid, "trapezoid"},
}};

// One task to work on and one to go on with while the result travels.
constexpr std::uint32_t kLeastHeld = 2;
// Bounds what a slow rank can hold on to, and what lies in rank 0's mailbox.
constexpr std::uint32_t kMostHeld = 16;
// The same in the end, when what one rank holds is what others wait for.
constexpr std::uint32_t kMostHeldAtTheEnd = 4;
constexpr std::uint32_t kLastTasksPerRank = 4;
// A master that renders looks at its mail every 0.1 ms or so. Ten times that keeps a fast worker from running dry.
constexpr double kSliceSeconds = 1e-4;
constexpr double kQueuedWorkSeconds = 1e-3;

// Tasks whose work, beyond the one in hand, lasts so long.
std::uint32_t held_to_cover(double latency_s, double task_s) noexcept {
  if (task_s * (kMostHeld - 1) <= latency_s) return kMostHeld;
  return std::max(kLeastHeld, 1 + static_cast<std::uint32_t>(std::ceil(latency_s / task_s)));
}

// What a task takes this rank. Its own recent tasks know how fast it is, the prediction knows the next one; the shorter
// answer keeps it from running dry.
double expected_task_s(const Standing& standing) noexcept {
  const bool is_predicted = standing.backlog.tasks_s > 0;
  return is_predicted ? std::min(standing.backlog.next_s, *standing.mean_task_s) : *standing.mean_task_s;
}

// The longest that rank 0 keeps a rank waiting: for a slice, and for a message from everybody.
double wait_for_master_s(const Standing& standing) noexcept {
  return kSliceSeconds + standing.ranks * kMasterSecondsPerTask;
}

// A round trip, where it takes longer than that; else 0.
double time_on_slow_wire(const Standing& standing) noexcept {
  const double round_trip_s = standing.round_trip_s.value_or(0);
  return round_trip_s > wait_for_master_s(standing) ? round_trip_s : 0;
}

// Whether the last tasks should wait at rank 0 and not behind one that a rank is at: where that one takes longer than
// the way to rank 0, and nobody has seen to it that the last ones are small.
bool is_end_of_long_tasks(const Standing& standing, double task_s) noexcept {
  return standing.backlog.tasks_s == 0 && standing.backlog.remaining < kLastTasksPerRank * standing.ranks &&
         task_s > wait_for_master_s(standing);
}

// How many tasks a worker should hold when it works a few ahead of its results.
std::uint32_t held_ahead(Policy policy, const Standing& standing) noexcept {
  if (!standing.mean_task_s) return kLeastHeld;
  const double task_s = expected_task_s(standing);
  const double wire_s = time_on_slow_wire(standing);
  const std::uint32_t most = held_to_cover(std::max(kQueuedWorkSeconds, 2 * wire_s), task_s);
  if (has_owners(policy)) return most;  // nobody else waits for these tasks
  if (wire_s == 0 && is_end_of_long_tasks(standing, task_s)) return 1;
  // Towards the end a deep queue would keep the last tasks from ranks that are idle, but over a slow wire a shallow one
  // would make all of them idle.
  const std::uint32_t least = std::min(held_to_cover(wire_s, task_s), kMostHeldAtTheEnd);
  return std::clamp(standing.backlog.remaining / (2 * standing.ranks), least, most);
}

// A rank that holds this many tasks gets no more.
std::uint32_t target_held(Policy policy, const Standing& standing) noexcept {
  if (standing.rank == kMasterRank) return 1;  // its results do not travel: there is no latency to hide
  if (standing.prefetch) return *standing.prefetch;
  const bool one_at_a_time = policy == Policy::self_scheduling || is_chunked(policy);
  return one_at_a_time ? 1 : held_ahead(policy, standing);
}

std::uint32_t tasks_in_chunk(Policy policy, const Backlog& backlog, std::uint32_t ranks) noexcept {
  if (policy == Policy::guided) return guided_chunk(backlog.remaining, ranks);
  if (policy == Policy::factoring) return factoring_chunk(backlog.tasks, backlog.remaining, ranks);
  return trapezoid_chunk(backlog.tasks, backlog.remaining, ranks);
}

double seconds_in_chunk(Policy policy, const Backlog& backlog, std::uint32_t ranks) noexcept {
  if (policy == Policy::guided) return guided_chunk_s(backlog.remaining_s, ranks);
  if (policy == Policy::factoring) return factoring_chunk_s(backlog.tasks_s, backlog.remaining_s, ranks);
  return trapezoid_chunk_s(backlog.tasks_s, backlog.remaining_s, ranks);
}

Share chunk(Policy policy, const Backlog& backlog, std::uint32_t ranks) noexcept {
  if (backlog.tasks_s > 0) return {backlog.remaining, seconds_in_chunk(policy, backlog, ranks)};
  return {std::min(tasks_in_chunk(policy, backlog, ranks), backlog.remaining), std::nullopt};
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

Share share_to_assign(Policy policy, const Standing& standing) noexcept {
  const std::uint32_t target = target_held(policy, standing);
  if (standing.held >= target) return {};
  if (is_chunked(policy) && standing.rank != kMasterRank) return chunk(policy, standing.backlog, standing.ranks);
  return {std::min(target - standing.held, standing.backlog.remaining), std::nullopt};
}

}  // namespace tessera::scheduler
