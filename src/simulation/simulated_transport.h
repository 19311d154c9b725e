// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "scheduler/transport.h"

namespace tessera::simulation {

/// Messages between simulated ranks. Each leaves at once; a rank takes those to it in the order in which they were
/// sent. An idle rank sleeps until one has arrived.
class SimulatedTransport final : public scheduler::Transport {
 public:
  /// To be made by the rank itself.
  SimulatedTransport(scheduler::Rank rank, std::uint32_t ranks);
  ~SimulatedTransport() override;

  scheduler::Rank rank() const noexcept override { return rank_; }
  std::uint32_t size() const noexcept override { return ranks_; }
  void wait_for_message(scheduler::Backoff& backoff) override;
  bool try_flush() override { return true; }
  void abandon(scheduler::Rank) override {}
  bool is_oversubscribed() const noexcept override { return false; }

 private:
  class Mailbox;

  void do_send(scheduler::Rank to, std::span<const std::byte> head, std::span<const std::byte> rest) override;
  std::optional<scheduler::Envelope> do_receive() override;

  scheduler::Rank rank_;
  std::uint32_t ranks_;
  std::unique_ptr<Mailbox> mailbox_;
  struct Letter;
  std::unique_ptr<Letter> arrived_;  ///< not handed out yet
  std::unique_ptr<Letter> open_;     ///< handed out
};

}  // namespace tessera::simulation
