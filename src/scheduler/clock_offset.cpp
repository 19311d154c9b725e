// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/clock_offset.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <vector>

namespace tessera::scheduler {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::uint64_t round_trip_ns(const ClockReading& reading) noexcept {
  return reading.answered_ns - reading.asked_ns;
}

/// The offsets with which a rank's tasks lie between their assignment and their return.
struct Range {
  double least = -kInfinity;
  double most = kInfinity;

  double nearest_to(double offset_s) const noexcept {
    return least <= most ? std::clamp(offset_s, least, most) : least + (most - least) / 2;
  }
};

}  // namespace

ClockOffset offset_from(std::span<const ClockReading> readings) noexcept {
  assert(!readings.empty());
  const ClockReading& best = *std::min_element(readings.begin(), readings.end(), [](const auto& a, const auto& b) {
    return round_trip_ns(a) < round_trip_ns(b);
  });
  const double half_trip_s = seconds_from_ns(round_trip_ns(best)) / 2;
  return {seconds_from_ns(best.asked_ns) + half_trip_s - seconds_from_ns(best.read_ns), half_trip_s};
}

void set_clock_offsets(RunRecord& run, std::span<const ClockOffset> offsets, const Stopwatch& clock) {
  const double run_began_s = run.clock.seconds_after(clock);
  std::vector<Range> possible(run.ranks.size());
  for (const TaskRecord& task : run.tasks) {
    Range& range = possible[task.rank];
    const bool was_told = task.assigned_s > 0;  // or the rank began with it, perhaps before rank 0 began
    if (was_told) range.least = std::max(range.least, task.assigned_s - task.start_s);
    range.most = std::min(range.most, task.received_s - task.end_s);
  }
  for (RankRecord& rank : run.ranks) {
    const ClockOffset& measured = offsets[rank.rank];
    if (rank.rank == kMasterRank) continue;  // its clock is the one that the others are compared with
    rank.clock_offset_s = possible[rank.rank].nearest_to(measured.offset_s - run_began_s);
    rank.clock_uncertainty_s = measured.uncertainty_s;
  }
}

}  // namespace tessera::scheduler
