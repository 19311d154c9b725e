// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/loopback.h"

#include <algorithm>
#include <utility>

namespace tessera::scheduler {

class LoopbackNetwork::Endpoint final : public Transport {
 public:
  Endpoint(LoopbackNetwork& network, Rank rank) : network_(network), rank_(rank) {}

  Rank rank() const noexcept override { return rank_; }
  std::uint32_t size() const noexcept override { return network_.size(); }
  void flush() override {}  // what is sent lies in the receiver's mailbox already
  bool is_oversubscribed() const noexcept override { return size() > 1; }

 private:
  void do_send(Rank to, Bytes&& message) override { network_.mailboxes_.at(to).push_back({rank_, std::move(message)}); }
  std::optional<Envelope> do_receive() override { return network_.deliver(rank_); }

  LoopbackNetwork& network_;
  Rank rank_;
};

LoopbackNetwork::LoopbackNetwork(std::uint32_t ranks, std::uint64_t seed) : random_(seed), mailboxes_(ranks) {
  for (Rank rank = 0; rank < ranks; ++rank) transports_.push_back(std::make_unique<Endpoint>(*this, rank));
}

LoopbackNetwork::~LoopbackNetwork() = default;

std::optional<Envelope> LoopbackNetwork::deliver(Rank to) {
  std::vector<Envelope>& mailbox = mailboxes_[to];
  const bool still_on_its_way = random_() % 4 == 0;
  if (mailbox.empty() || still_on_its_way) return std::nullopt;

  // Choose a source by one of its messages, then take the first of that source.
  const Rank source = mailbox[random_() % mailbox.size()].source;
  const auto first =
      std::find_if(mailbox.begin(), mailbox.end(), [&](const Envelope& e) { return e.source == source; });
  Envelope envelope = std::move(*first);
  mailbox.erase(first);
  return envelope;
}

}  // namespace tessera::scheduler
