// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include "scheduler/backoff.h"

// Internal to this folder: the headers for others don't include mpi.h.
namespace tessera::scheduler::mpi {

/// Owns a communicator whose errors are returned, not fatal.
class Communicator {
 public:
  /// All processes of the job, apart from whatever else uses MPI_COMM_WORLD. Collective.
  static Communicator of_job();

  /// The processes of `whole` that share this one's memory. Collective.
  static Communicator of_node(const Communicator& whole);

  /// The processes of `whole` that are in the same part as this one, in the same order. Collective.
  /// shapes:  0 <= part < 2^31
  static Communicator of_part(const Communicator& whole, int part);

  /// The same processes once more, apart from what goes on in `original`. Collective, and waiting gives way as
  /// `patience` says.
  static Communicator copy_of(const Communicator& original, Patience patience);

  Communicator(Communicator&& other) noexcept;
  Communicator& operator=(Communicator&&) = delete;
  ~Communicator();

  MPI_Comm get() const noexcept { return handle_; }
  int rank() const;
  int size() const;

 private:
  explicit Communicator(MPI_Comm handle) : handle_(handle) {}

  MPI_Comm handle_;
};

}  // namespace tessera::scheduler::mpi
