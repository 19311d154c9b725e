// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <optional>
#include <variant>

#include "scheduler/loopback.h"
#include "scheduler/message.h"

// The other end of a run, played by a test that sends and takes its messages by hand.
namespace tessera::scheduler {

inline RunList run_of(std::uint32_t first, std::uint32_t count) {
  RunList runs;
  runs.push(TaskRun{TaskId{first}, count});
  return runs;
}

/// The next message that lies in a rank's mailbox, or none: the network says no now and then although there is one.
inline std::optional<Bytes> next_bytes(Transport& transport) {
  for (int look = 0; look < 100; ++look) {
    if (const auto envelope = transport.receive()) return Bytes(envelope->bytes.begin(), envelope->bytes.end());
  }
  return std::nullopt;
}

/// The next message in the mailbox, which must be there and of this kind. Its payload is gone with it.
template <class Wanted>
Wanted take(Transport& transport) {
  const std::optional<Bytes> bytes = next_bytes(transport);
  BOOST_REQUIRE_MESSAGE(bytes.has_value(), "there is no message");
  const Message message = decode(*bytes);
  BOOST_REQUIRE_MESSAGE(std::holds_alternative<Wanted>(message), "it is another message: " << message.index());
  return std::get<Wanted>(message);
}

/// A result in one piece.
inline Bytes encode_whole(ResultMessage result, const Bytes& payload) {
  result.payload = payload;
  const auto header = encode_header(result);
  Bytes whole(header.size() + payload.size());
  std::copy(payload.begin(), payload.end(), std::copy(header.begin(), header.end(), whole.begin()));
  return whole;
}

/// A result as a worker sends it; its payload is this many bytes of this value.
inline Bytes result_of(std::uint32_t task, std::size_t size = 3, int value = 7, std::uint64_t busy_ns = 1000) {
  return encode_whole(ResultMessage{TaskId{task}, 10, busy_ns, {}}, Bytes(size, static_cast<std::byte>(value)));
}

}  // namespace tessera::scheduler
