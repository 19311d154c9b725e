// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "scheduler/clock_offset.h"
#include "scheduler/mpi/session.h"
#include "scheduler/stopwatch.h"

namespace tessera::scheduler::mpi {

/// Rank 0 asks each other rank in turn, several times, what its `clock` shows. All ranks call it; rank 0 gets one
/// offset per rank, its own of 0 included, the others nothing. Waiting gives the core away.
/// throws:  std::runtime_error
std::vector<ClockOffset> measure_clock_offsets(const Session& session, const Stopwatch& clock);

}  // namespace tessera::scheduler::mpi
