// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "scheduler/transport.h"

// Ranks that live in one thread of one process. What MPI leaves to chance is drawn here from a seed, so every history
// can be repeated.
namespace tessera::scheduler {

/// In which order a rank's messages arrive.
enum class Order : std::uint8_t { any, as_sent };

/// Delivers, and now and then says that nothing is here yet although something is on its way. Equal seeds and equal
/// calls give equal deliveries, on every platform.
class LoopbackNetwork {
 public:
  LoopbackNetwork(std::uint32_t ranks, std::uint64_t seed, Order order = Order::any);
  ~LoopbackNetwork();

  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(mailboxes_.size()); }

  /// The transport of a rank; lives as long as the network.
  Transport& transport(Rank rank) noexcept { return *transports_[rank]; }

 private:
  class Endpoint;

  struct Letter {
    Rank source = 0;
    Bytes bytes;
  };

  std::optional<Letter> deliver(Rank to);

  std::mt19937_64 random_;
  Order order_;
  std::vector<std::vector<Letter>> mailboxes_;  ///< per receiver
  std::vector<std::unique_ptr<Transport>> transports_;
};

}  // namespace tessera::scheduler
