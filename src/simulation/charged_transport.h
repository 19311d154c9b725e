// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>

#include "scheduler/transport.h"
#include "simulation/replay.h"

namespace tessera::simulation {

/// What a message costs the rank that takes it: its own time to receive, decide and answer.
struct MessageCost {
  double per_message_s = 0;
  double per_byte_s = 0;
};

/// Another transport whose messages take time on the receiving rank, before it sees them.
class ChargedTransport final : public scheduler::Transport {
 public:
  /// `carrier` must outlive this.
  ChargedTransport(scheduler::Transport& carrier, MessageCost cost, Spend spend)
      : carrier_(carrier), cost_(cost), spend_(std::move(spend)) {}

  scheduler::Rank rank() const noexcept override { return carrier_.rank(); }
  std::uint32_t size() const noexcept override { return carrier_.size(); }
  void wait_for_message(scheduler::Backoff& backoff) override { carrier_.wait_for_message(backoff); }
  bool try_flush() override { return carrier_.try_flush(); }
  void abandon(scheduler::Rank rank) override { carrier_.abandon(rank); }
  bool is_oversubscribed() const noexcept override { return carrier_.is_oversubscribed(); }

 private:
  void do_send(scheduler::Rank to, std::span<const std::byte> head, std::span<const std::byte> rest) override {
    carrier_.send(to, head, rest);
  }

  std::optional<scheduler::Envelope> do_receive() override {
    std::optional<scheduler::Envelope> envelope = carrier_.receive();
    if (envelope) spend_(cost_.per_message_s + cost_.per_byte_s * static_cast<double>(envelope->bytes.size()));
    return envelope;
  }

  scheduler::Transport& carrier_;
  MessageCost cost_;
  Spend spend_;
};

}  // namespace tessera::simulation
