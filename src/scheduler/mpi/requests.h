// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

namespace tessera::scheduler::mpi {

/// Requests whose completion is asked for together.
class Requests {
 public:
  /// Asks for what has completed since. Those become MPI_REQUEST_NULL.
  /// throws:  std::runtime_error
  void test();

  /// What the last `test` found, in ascending order, and the status of each.
  std::span<const int> completed() const noexcept { return {indices_.data(), count_}; }
  const MPI_Status& status(std::size_t i) const noexcept { return statuses_[i]; }

  void push(MPI_Request request) { all_.push_back(request); }
  /// Puts the last one in the place of i. What `test` found is void then.
  void remove(std::size_t i) {
    all_[i] = all_.back();
    all_.pop_back();
  }

  MPI_Request& operator[](std::size_t i) noexcept { return all_[i]; }
  std::size_t size() const noexcept { return all_.size(); }
  bool empty() const noexcept { return all_.empty(); }

 private:
  std::vector<MPI_Request> all_;
  std::vector<int> indices_;
  std::vector<MPI_Status> statuses_;
  std::size_t count_ = 0;
};

}  // namespace tessera::scheduler::mpi
