// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tessera::scheduler::mpi {

class Session;

enum class Sharing : std::uint8_t { if_possible, never };

/// Bytes that the first rank of a node fills and all its ranks read: one copy, or, where the system does not let
/// processes share memory, one each. The memory is the process's own from then on: nobody waits for others to give it
/// up, and it may outlive MPI.
class NodeMemory {
 public:
  /// Makes it; the size that the node's first rank gives counts. Collective on a node.
  /// throws:  std::bad_alloc, std::runtime_error
  NodeMemory(Session& session, std::size_t bytes, Sharing sharing = Sharing::if_possible);
  NodeMemory(const NodeMemory&) = delete;
  NodeMemory& operator=(const NodeMemory&) = delete;
  ~NodeMemory();

  /// To be written by the node's first rank alone, before it is published. Begins at a page.
  std::span<std::byte> bytes() const noexcept { return bytes_; }
  bool is_shared() const noexcept { return shared_; }

  /// Returns when all ranks of the node can read what the first wrote. Collective on a node.
  void publish(Session& session);

 private:
  std::span<std::byte> bytes_;
  bool shared_ = false;
};

}  // namespace tessera::scheduler::mpi
