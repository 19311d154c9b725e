// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "scheduler/backoff.h"
#include "scheduler/bytes.h"
#include "scheduler/task.h"

// The life of MPI in a process, and the few things that all ranks do together.
namespace tessera::scheduler::mpi {

class Communicator;

/// A bit for each core, as the system counts them.
using CoreSet = std::array<unsigned long, 16>;

/// MPI is there while this lives; make one, early in main, and never a second.
///
/// How errors end a job: the others cannot know that a rank failed, they would wait for ever. So a caller catches what
/// a rank throws while the session is alive, prints its line, and calls `abort` with the exit code, which ends every
/// rank and becomes mpirun's own code. As a safety net a session that an exception passes through does the same with
/// code 70. Only an error that every rank meets alike may take the normal way out.
class Session {
 public:
  static constexpr std::size_t kPieceBytes = std::size_t{1} << 28;

  /// More ranks that share memory than `most_on_node` count as several nodes: so tests have some on one machine.
  /// shapes:  most_on_node >= 1
  /// throws:  std::runtime_error where MPI cannot give what is needed
  explicit Session(int& argc, char**& argv, std::uint32_t most_on_node = std::numeric_limits<std::uint32_t>::max());
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session();

  Rank rank() const noexcept { return rank_; }
  std::uint32_t size() const noexcept { return size_; }
  std::uint32_t nodes() const noexcept { return nodes_; }

  /// Whether on this rank's node there are more ranks than cores that they may run on.
  bool is_oversubscribed() const noexcept { return oversubscribed_; }

  /// Ranks that share this one's memory, itself included, and whether this is the first of them.
  std::uint32_t ranks_on_node() const noexcept { return ranks_on_node_; }
  bool is_first_on_node() const noexcept { return first_on_node_; }

  /// What implements MPI, "Open MPI v4.1.4".
  std::string library() const;

  /// Returns when all ranks are here. Waiting gives the core away.
  void barrier();

  /// Replaces `bytes` on every rank by those of rank 0, which may come much later than the others: waiting gives the
  /// core away. They travel in pieces of `piece_bytes`, for MPI counts in int.
  /// shapes:  1 <= piece_bytes < 2^31, the same on all ranks
  /// throws:  std::invalid_argument, std::runtime_error
  void broadcast(Bytes& bytes, std::size_t piece_bytes = kPieceBytes);

  /// The same where the others know how many bytes there are.
  void broadcast(std::span<std::byte> bytes, std::size_t piece_bytes = kPieceBytes);

  /// The same from rank 0 to the first rank of each node; the others have no part in it.
  void broadcast_to_nodes(std::span<std::byte> bytes, std::size_t piece_bytes = kPieceBytes);

  /// The same among the ranks of a node, from the first of them.
  void broadcast_on_node(std::span<std::byte> bytes, std::size_t piece_bytes = kPieceBytes);

  /// Whether all ranks of the node say yes.
  bool do_all_on_node(bool yes);

  /// How this rank waits for others.
  Patience patience() const noexcept { return oversubscribed_ ? Patience::yield_only : Patience::spin_first; }

  /// When the session ends, finalising MPI has two seconds; where it hangs, the process ends with code 0. See
  /// farewell.h.
  void note_lost_rank() noexcept { rank_is_lost_ = true; }

  /// Ends every rank of the job at once; `code` becomes the job's exit code.
  [[noreturn]] void abort(int code) noexcept;

  const Communicator& communicator() const noexcept { return *communicator_; }

 private:
  friend class NodeCores;

  int exceptions_before_;
  bool rank_is_lost_ = false;
  std::unique_ptr<Communicator> communicator_;
  std::unique_ptr<Communicator> node_;
  std::unique_ptr<Communicator> first_ranks_;  ///< of all nodes; null where this is none of them
  Rank rank_ = 0;
  std::uint32_t size_ = 1;
  std::uint32_t nodes_ = 1;
  std::uint32_t ranks_on_node_ = 1;
  bool first_on_node_ = true;
  CoreSet node_cores_{};
  bool oversubscribed_ = false;
};

/// While it lives, this thread and those that it starts may run on every core that any rank of the node may run on: for
/// work that one rank does for all of them while they wait.
class NodeCores {
 public:
  explicit NodeCores(const Session& session) noexcept;
  NodeCores(const NodeCores&) = delete;
  NodeCores& operator=(const NodeCores&) = delete;
  ~NodeCores();

  /// How many threads are the node's ranks' share: one a rank, but no more than there are cores.
  unsigned threads() const noexcept { return threads_; }

 private:
  CoreSet before_{};
  unsigned threads_;
};

}  // namespace tessera::scheduler::mpi
