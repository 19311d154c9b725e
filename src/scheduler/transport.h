// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "scheduler/backoff.h"
#include "scheduler/bytes.h"
#include "scheduler/task.h"

// How a rank exchanges messages with the others, whatever carries them.
namespace tessera::scheduler {

/// A message and where it came from.
struct Envelope {
  Rank source = 0;
  std::span<const std::byte> bytes;  ///< gone with the next `receive`
};

/// Messages arrive complete and once, in any order, between the same two ranks too. No call waits, except flush and
/// wait_for_message.
class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  virtual Rank rank() const noexcept = 0;
  virtual std::uint32_t size() const noexcept = 0;  ///< ranks in all

  /// Sends one message, `head` and then `rest`, on its way. Both are copied.
  void send(Rank to, std::span<const std::byte> head, std::span<const std::byte> rest = {}) {
    ++sent_.count;
    sent_.bytes += head.size() + rest.size();
    do_send(to, head, rest);
  }

  /// The next message that is here, or nullopt.
  std::optional<Envelope> receive() {
    std::optional<Envelope> envelope = do_receive();
    if (envelope) {
      ++received_.count;
      received_.bytes += envelope->bytes.size();
    }
    return envelope;
  }

  /// To be called where `receive` found nothing: gives way for a while, as `backoff` says, or, where time is simulated,
  /// until there is something to receive.
  virtual void wait_for_message(Backoff& backoff) { backoff.wait(); }

  /// Moves on what was sent, and says whether all of it has left, but for what went to abandoned ranks.
  virtual bool try_flush() = 0;

  /// Waits until try_flush says yes: for ever, where a rank that takes nothing any more is not abandoned.
  void flush() {
    Backoff backoff(patience());
    while (!try_flush()) backoff.wait();
  }

  /// Waits no longer for a rank that is lost: neither for what was sent to it, nor for the rest of a large message that
  /// it has begun to send. What it sends whole is received all the same.
  virtual void abandon(Rank rank) = 0;

  /// Whether other ranks need this rank's core, so that waiting must not burn it.
  virtual bool is_oversubscribed() const noexcept = 0;

  Patience patience() const noexcept { return is_oversubscribed() ? Patience::yield_only : Patience::spin_first; }

  const Traffic& sent() const noexcept { return sent_; }
  const Traffic& received() const noexcept { return received_; }

 private:
  virtual void do_send(Rank to, std::span<const std::byte> head, std::span<const std::byte> rest) = 0;
  virtual std::optional<Envelope> do_receive() = 0;

  Traffic sent_;
  Traffic received_;
};

}  // namespace tessera::scheduler
