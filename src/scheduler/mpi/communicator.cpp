// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/communicator.h"

#include <utility>

#include "scheduler/mpi/check.h"

namespace tessera::scheduler::mpi {

Communicator Communicator::of_job() {
  // Set before the first call that can fail; what is made from a communicator inherits it.
  check(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  MPI_Comm handle = MPI_COMM_NULL;
  check(MPI_Comm_dup(MPI_COMM_WORLD, &handle), "MPI_Comm_dup");
  Communicator job(handle);
  check(MPI_Comm_set_errhandler(handle, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  return job;
}

Communicator Communicator::of_node(const Communicator& whole) {
  MPI_Comm handle = MPI_COMM_NULL;
  check(MPI_Comm_split_type(whole.get(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &handle), "MPI_Comm_split_type");
  Communicator node(handle);
  check(MPI_Comm_set_errhandler(handle, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  return node;
}

Communicator Communicator::of_part(const Communicator& whole, int part) {
  MPI_Comm handle = MPI_COMM_NULL;
  check(MPI_Comm_split(whole.get(), part, 0, &handle), "MPI_Comm_split");
  Communicator same(handle);
  check(MPI_Comm_set_errhandler(handle, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  return same;
}

Communicator Communicator::copy_of(const Communicator& original, Patience patience) {
  MPI_Comm handle = MPI_COMM_NULL;
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Comm_idup(original.get(), &handle, &request), "MPI_Comm_idup");
  Backoff backoff(patience);
  for (int complete = 0;;) {
    check(MPI_Test(&request, &complete, MPI_STATUS_IGNORE), "MPI_Test");
    if (complete != 0) break;
    backoff.wait();
  }
  Communicator copy(handle);
  check(MPI_Comm_set_errhandler(handle, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  return copy;
}

Communicator::Communicator(Communicator&& other) noexcept : handle_(std::exchange(other.handle_, MPI_COMM_NULL)) {}

Communicator::~Communicator() {
  if (handle_ != MPI_COMM_NULL) MPI_Comm_free(&handle_);
}

int Communicator::rank() const {
  int rank = 0;
  check(MPI_Comm_rank(handle_, &rank), "MPI_Comm_rank");
  return rank;
}

int Communicator::size() const {
  int size = 0;
  check(MPI_Comm_size(handle_, &size), "MPI_Comm_size");
  return size;
}

}  // namespace tessera::scheduler::mpi
