// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scheduler/mpi/buffers.h"
#include "scheduler/mpi/channel.h"
#include "scheduler/mpi/requests.h"
#include "scheduler/task.h"

namespace tessera::scheduler::mpi {

/// What was sent and has not left.
class Outbox {
 public:
  explicit Outbox(const Channel& channel) noexcept : channel_(channel) {}
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;
  ~Outbox();

  /// throws:  std::length_error, std::runtime_error
  void send(Rank to, std::span<const std::byte> head, std::span<const std::byte> rest);

  /// Takes back the memory of what has left.
  void reap();

  /// Whether all has left, but for what went to abandoned ranks.
  bool is_empty() const noexcept { return waiting_ == 0; }

  void abandon(Rank rank);

 private:
  struct Parcel {
    Rank to = 0;
    Bytes bytes;
  };

  void start(Rank to, Bytes&& bytes, int tag, const Communicator& communicator);
  bool is_abandoned(Rank rank) const noexcept { return rank < abandoned_.size() && abandoned_[rank]; }

  const Channel& channel_;
  Requests requests_;
  std::vector<Parcel> parcels_;  ///< of the same indices as the requests
  std::size_t waiting_ = 0;      ///< parcels to ranks that are not abandoned
  std::vector<bool> abandoned_;  ///< as long as the highest rank that is
  std::int32_t next_long_tag_ = 0;
  Buffers buffers_;
};

}  // namespace tessera::scheduler::mpi
