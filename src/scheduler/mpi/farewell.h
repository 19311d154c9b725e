// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scheduler/record.h"

// How a job ends. MPI_Finalize waits for every process of the job. Where one is stopped it waits for ever, and where
// one was killed it sometimes does (Open MPI 4.1.4), while mpirun across hosts waits for ranks that never finalised. So
// once a rank is lost, what is left of it is ended, and the others finalise for two seconds at most.
namespace tessera::scheduler::mpi {

class Session;

/// Rank 0, once it has nothing more to do: ends the processes of lost ranks, or has them ended by a rank on their host,
/// and lets the others go. A process that is stopped on a host without other ranks stays.
void dismiss(Session& session, const RunRecord& run);

/// The others: waits until rank 0 lets them go. Waiting gives the core away.
void await_dismissal(Session& session);

}  // namespace tessera::scheduler::mpi
