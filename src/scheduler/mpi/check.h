// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tessera::scheduler::mpi {

/// Passes where an MPI call returned success.
/// throws:  std::runtime_error "MPI_Isend failed (<MPI's own words>)"
void check(int code, const char* call);

}  // namespace tessera::scheduler::mpi
