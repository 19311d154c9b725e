// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/loopback.h"

#include <utility>

namespace tessera::scheduler {

class LoopbackNetwork::Endpoint final : public Transport {
 public:
  Endpoint(LoopbackNetwork& network, Rank rank) : network_(network), rank_(rank) {}

  Rank rank() const noexcept override { return rank_; }
  std::uint32_t size() const noexcept override { return network_.size(); }
  bool try_flush() override { return true; }  // what is sent lies in the receiver's mailbox already
  void abandon(Rank) override {}
  bool is_oversubscribed() const noexcept override { return size() > 1; }

 private:
  void do_send(Rank to, std::span<const std::byte> head, std::span<const std::byte> rest) override {
    Letter letter{rank_, Bytes(head.begin(), head.end())};
    letter.bytes.insert(letter.bytes.end(), rest.begin(), rest.end());
    network_.mailboxes_.at(to).push_back(std::move(letter));
  }

  std::optional<Envelope> do_receive() override {
    opened_ = network_.deliver(rank_);
    if (!opened_) return std::nullopt;
    return Envelope{opened_->source, opened_->bytes};
  }

  LoopbackNetwork& network_;
  Rank rank_;
  std::optional<Letter> opened_;  ///< what the last envelope shows
};

LoopbackNetwork::LoopbackNetwork(std::uint32_t ranks, std::uint64_t seed, Order order)
    : random_(seed), order_(order), mailboxes_(ranks) {
  for (Rank rank = 0; rank < ranks; ++rank) transports_.push_back(std::make_unique<Endpoint>(*this, rank));
}

LoopbackNetwork::~LoopbackNetwork() = default;

std::optional<LoopbackNetwork::Letter> LoopbackNetwork::deliver(Rank to) {
  std::vector<Letter>& mailbox = mailboxes_[to];
  const bool still_on_its_way = random_() % 4 == 0;
  if (mailbox.empty() || still_on_its_way) return std::nullopt;
  const auto chosen =
      mailbox.begin() + static_cast<std::ptrdiff_t>(order_ == Order::any ? random_() % mailbox.size() : 0);
  Letter letter = std::move(*chosen);
  mailbox.erase(chosen);
  return letter;
}

}  // namespace tessera::scheduler
