// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "scheduler/bytes.h"
#include "scheduler/task.h"

// How a rank exchanges messages with the others, whatever carries them.
namespace tessera::scheduler {

/// A message and where it came from.
struct Envelope {
  Rank source = 0;
  Bytes bytes;
};

/// Messages from one rank to another arrive complete, once, and in the order in which they were sent; between
/// different pairs there is no order. No call waits, except flush.
class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  virtual Rank rank() const noexcept = 0;
  virtual std::uint32_t size() const noexcept = 0;  ///< ranks in all

  /// Sends `message` on its way and keeps its memory until it has left.
  void send(Rank to, Bytes&& message) {
    ++sent_.count;
    sent_.bytes += message.size();
    do_send(to, std::move(message));
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

  /// Waits until everything sent has left.
  virtual void flush() = 0;

  /// Whether other ranks need this rank's core, so that waiting must not burn it.
  virtual bool is_oversubscribed() const noexcept = 0;

  const Traffic& sent() const noexcept { return sent_; }
  const Traffic& received() const noexcept { return received_; }

 private:
  virtual void do_send(Rank to, Bytes&& message) = 0;
  virtual std::optional<Envelope> do_receive() = 0;

  Traffic sent_;
  Traffic received_;
};

}  // namespace tessera::scheduler
