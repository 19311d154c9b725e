// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "scheduler/mpi/buffers.h"
#include "scheduler/mpi/channel.h"
#include "scheduler/mpi/requests.h"
#include "scheduler/transport.h"

namespace tessera::scheduler::mpi {

/// What is arriving. Short messages find a receive that waits for them, so taking one is a look into memory. Long ones
/// arrive one at a time from each rank and of a few ranks at a time; those of others pass them.
class Inbox {
 public:
  /// Posts the receives.
  /// throws:  std::runtime_error
  Inbox(const Channel& channel, std::uint32_t ranks);
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;

  /// Calls back the receives that are posted.
  ~Inbox();

  /// throws:  std::runtime_error
  std::optional<Envelope> take();

  void abandon(Rank rank);

 private:
  /// A long message that was announced.
  struct Announced {
    Rank source = 0;
    Announcement announcement;
  };
  /// A long message whose receive is posted.
  /// shapes:  bytes is at least so long
  struct Arriving {
    Rank source = 0;
    std::size_t length = 0;
    Bytes bytes;
  };

  void post(std::size_t slot);
  void look();
  std::optional<Envelope> next_short();
  std::optional<Envelope> next_long();
  void note(Rank source, std::span<const std::byte> announcement);
  void begin_announced();
  std::span<std::byte> slot_memory(std::size_t slot) noexcept;

  const Channel& channel_;

  Bytes memory_;                     ///< of the slots
  Requests slots_;                   ///< receives posted beforehand
  std::size_t next_completed_ = 0;   ///< of those that the last look found
  std::optional<std::size_t> open_;  ///< the slot whose message was handed out

  std::deque<Announced> announced_;
  Requests long_requests_;
  std::vector<Arriving> arriving_;    ///< of the same indices as long_requests_
  std::vector<Arriving> arrived_;     ///< not handed out yet
  std::vector<bool> is_arriving_of_;  ///< rank -> whether it is the source of one in arriving_
  Bytes open_long_;                   ///< the long message that was handed out
  Buffers buffers_;
};

}  // namespace tessera::scheduler::mpi
