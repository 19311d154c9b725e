// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scheduler/task.h"

// What the environment says about an MPI launcher, before or without MPI.
namespace tessera::scheduler {

/// Whether mpirun or the like started this process. Without one, initialising MPI only costs time.
bool launched_by_mpi() noexcept;

/// The rank that the launcher gave this process, 0 without a launcher: who may print before MPI is there.
Rank launched_rank() noexcept;

}  // namespace tessera::scheduler
