// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>

#include "scheduler/mpi/session.h"
#include "scheduler/transport.h"

namespace tessera::scheduler::mpi {

/// The longest message that goes into a receive posted beforehand, see channel.h. Below MPI's eager limits (4,096 bytes
/// with its header in Open MPI's shared memory, more elsewhere), so that it arrives whole or not at all: a sender that
/// dies keeps no receive from being used again.
inline constexpr std::size_t kShortBytes = 4000;

/// Messages between the ranks of a session. Open MPI makes no progress by itself: a message above the eager limit (4 KB
/// in shared memory) moves only while its sender calls `receive` or `flush`, so a rank calls `receive` often, even
/// where it expects nothing.
class MpiTransport final : public Transport {
 public:
  /// All ranks together: returns when all are here. Waiting gives the core away.
  /// `session` must outlive this.
  explicit MpiTransport(const Session& session);

  /// Call `flush` before. What is still on its way, because an exception ends the rank, stays allocated for good.
  ~MpiTransport() override;

  Rank rank() const noexcept override { return session_.rank(); }
  std::uint32_t size() const noexcept override { return session_.size(); }
  bool try_flush() override;
  void abandon(Rank rank) override;
  bool is_oversubscribed() const noexcept override { return session_.is_oversubscribed(); }

 private:
  struct Boxes;

  void do_send(Rank to, std::span<const std::byte> head, std::span<const std::byte> rest) override;
  std::optional<Envelope> do_receive() override;

  const Session& session_;
  std::unique_ptr<Boxes> boxes_;
};

}  // namespace tessera::scheduler::mpi
