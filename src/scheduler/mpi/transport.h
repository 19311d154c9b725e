// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "scheduler/mpi/session.h"
#include "scheduler/transport.h"

namespace tessera::scheduler::mpi {

/// Messages between the ranks of a session. Open MPI makes no progress by itself: a message above the eager limit (4 KB
/// in shared memory) moves only while its sender calls `receive` or `flush`, so a rank calls `receive` often, even
/// where it expects nothing.
class MpiTransport final : public Transport {
 public:
  /// `session` must outlive this.
  explicit MpiTransport(const Session& session);

  /// Call `flush` before. What is still on its way, because an exception ends the rank, stays allocated for good.
  ~MpiTransport() override;

  Rank rank() const noexcept override { return session_.rank(); }
  std::uint32_t size() const noexcept override { return session_.size(); }
  void flush() override;
  bool is_oversubscribed() const noexcept override { return session_.is_oversubscribed(); }

 private:
  class Outbox;
  class Inbox;

  void do_send(Rank to, Bytes&& message) override;
  std::optional<Envelope> do_receive() override;

  const Session& session_;
  std::unique_ptr<Outbox> outbox_;
  std::unique_ptr<Inbox> inbox_;
};

}  // namespace tessera::scheduler::mpi
