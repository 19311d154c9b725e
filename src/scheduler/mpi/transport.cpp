// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/transport.h"

#include "scheduler/mpi/channel.h"
#include "scheduler/mpi/inbox.h"
#include "scheduler/mpi/outbox.h"

namespace tessera::scheduler::mpi {

struct MpiTransport::Boxes {
  explicit Boxes(const Session& session)
      : channel(session.communicator(), session.patience()), outbox(channel), inbox(channel, session.size()) {}

  Channel channel;
  Outbox outbox;
  Inbox inbox;
};

MpiTransport::MpiTransport(const Session& session) : session_(session), boxes_(std::make_unique<Boxes>(session)) {}

MpiTransport::~MpiTransport() = default;

bool MpiTransport::try_flush() {
  boxes_->outbox.reap();
  return boxes_->outbox.is_empty();
}

void MpiTransport::abandon(Rank rank) {
  boxes_->outbox.abandon(rank);
  boxes_->inbox.abandon(rank);
}

void MpiTransport::do_send(Rank to, std::span<const std::byte> head, std::span<const std::byte> rest) {
  boxes_->outbox.send(to, head, rest);
}

std::optional<Envelope> MpiTransport::do_receive() {
  boxes_->outbox.reap();
  return boxes_->inbox.take();
}

}  // namespace tessera::scheduler::mpi
