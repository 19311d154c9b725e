// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "scheduler/bytes.h"

namespace tessera::scheduler::mpi {

/// Memory of messages that are gone, kept for those that come, so that a message costs no allocation.
class Buffers {
 public:
  static constexpr std::size_t kMostKeptBytes = std::size_t{4} << 20;

  /// A buffer of any length and content.
  Bytes take() {
    if (spare_.empty()) return {};
    Bytes buffer = std::move(spare_.back());  // the one that was used last: it is still in the cache
    spare_.pop_back();
    kept_bytes_ -= buffer.capacity();
    return buffer;
  }

  void give_back(Bytes&& buffer) {
    if (buffer.capacity() > kMostKeptBytes - kept_bytes_) {
      Bytes().swap(buffer);
      return;
    }
    kept_bytes_ += buffer.capacity();
    spare_.push_back(std::move(buffer));
  }

 private:
  std::vector<Bytes> spare_;
  std::size_t kept_bytes_ = 0;
};

/// Gives up memory that MPI may still read or write.
inline void leave_to_mpi(Bytes&& buffer) {
  static_cast<void>(new Bytes(std::move(buffer)));
}

}  // namespace tessera::scheduler::mpi
