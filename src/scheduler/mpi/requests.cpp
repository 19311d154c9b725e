// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/requests.h"

#include "scheduler/mpi/check.h"

namespace tessera::scheduler::mpi {

void Requests::test() {
  count_ = 0;
  if (all_.empty()) return;
  if (indices_.size() < all_.size()) {
    indices_.resize(all_.size());
    statuses_.resize(all_.size());
  }
  int completed = 0;
  check(MPI_Testsome(static_cast<int>(all_.size()), all_.data(), &completed, indices_.data(), statuses_.data()),
        "MPI_Testsome");
  // Where no request is active, MPI says "undefined".
  if (completed != MPI_UNDEFINED) count_ = static_cast<std::size_t>(completed);
}

}  // namespace tessera::scheduler::mpi
