// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "scheduler/record.h"

// Each rank takes down times on a clock of its own. To lay them side by side, rank 0 asks the others what time it is.
namespace tessera::scheduler {

/// One question to a rank and its answer.
/// units:   nanoseconds on the clock of who reads it
struct ClockReading {
  std::uint64_t asked_ns = 0;     ///< on rank 0's clock
  std::uint64_t read_ns = 0;      ///< on the rank's clock, some time in between
  std::uint64_t answered_ns = 0;  ///< on rank 0's clock
};

/// What turns a rank's times into rank 0's.
/// units:   seconds
struct ClockOffset {
  double offset_s = 0;  ///< to be added to the rank's times
  double uncertainty_s = 0;
};

/// The offset from the reading with the shortest round trip, as if the clock had been read in its middle.
/// shapes:  at least one reading
/// error:   at most uncertainty_s, half of that round trip, as long as the two clocks go equally fast
/// source:  Cristian, Probabilistic clock synchronization, Distributed Computing 3 (1989)
ClockOffset offset_from(std::span<const ClockReading> readings) noexcept;

/// Takes measured offsets into a run's record and moves each as little as it takes that nobody began a task before
/// rank 0 handed it out, and rank 0 had no result before it was there; that can only bring it nearer to the true one.
/// Where the clocks went so unequally that no offset does it, the middle of what the two ends ask for. `clock` is rank
/// 0's on which the offsets were measured, which need not be the run's.
/// shapes:  one per rank, in the order of ranks
void set_clock_offsets(RunRecord& run, std::span<const ClockOffset> offsets, const Stopwatch& clock);

}  // namespace tessera::scheduler
