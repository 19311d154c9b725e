// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "scheduler/plan.h"
#include "scheduler/record.h"
#include "scheduler/stopwatch.h"
#include "scheduler/transport.h"
#include "scheduler/work.h"

// Runs a plan to its end. Where the ranks are processes, rank 0 calls run_master and the others run_worker, all of them
// at the same moment (after a barrier), for there a rank's clock starts.
namespace tessera::scheduler {

/// Hands out the plan's tasks, accepts each result once, and renders too if its role says so. The makespan ends with
/// the last acceptance; the call returns when every worker has gone home or is given up. With one rank no message is
/// sent. The times of the record are those of `clock`.
/// throws:  std::invalid_argument where the plan is not feasible, std::runtime_error where a rank breaks the protocol,
///          and what `work`, `accept` and `pulse` throw. The other ranks then wait for ever: the caller ends them.
RunRecord run_master(
    Transport& transport, const Plan& plan, const Work& work, const Accept& accept, const Pulse& pulse = [] {},
    const Stopwatch& clock = Stopwatch());

/// Renders what the plan says and rank 0 assigns until it says stop. The plan is the same on all ranks. The times of
/// its results are those of `clock`, for a caller who knows how that one differs from rank 0's.
/// throws:  std::runtime_error on a message that it cannot follow, and what `work` throws
void run_worker(Transport& transport, const Plan& plan, const Work& work, const Stopwatch& clock = Stopwatch());

/// The same with all ranks in this thread: a random rank takes the next step, messages arrive in a random order, and
/// both follow from `seed`. One rank does without either. Nobody is given up, for ranks that take turns keep no time.
/// throws:  as run_master and run_worker; std::logic_error if no rank makes progress any more
RunRecord run_in_process(
    std::uint32_t ranks, std::uint64_t seed, const Plan& plan, const Work& work, const Accept& accept,
    const Pulse& pulse = [] {});

}  // namespace tessera::scheduler
