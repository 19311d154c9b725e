// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "scheduler/bytes.h"
#include "scheduler/task.h"

// The four messages of the protocol and their bytes. Every field has a fixed width and is little-endian; a message
// begins with four letters that say its kind. Decoding takes nothing on trust.
//
//   HELO  64 B  worker -> master  version, pid, host      "I am here"
//   ASGN  32 B  master -> worker  up to 3 runs of tasks   "do these, after what you have"
//   RSLT  24 B  worker -> master  task, times, payload    "this is done, give me more"
//   STOP   4 B  master -> worker                          "go home"
namespace tessera::scheduler {

inline constexpr std::uint32_t kProtocolVersion = 1;

inline constexpr std::size_t kHelloBytes = 64;
inline constexpr std::size_t kAssignBytes = 32;
inline constexpr std::size_t kResultHeaderBytes = 24;  ///< the payload follows
inline constexpr std::size_t kStopBytes = 4;

/// The host name is cut to what fits, 51 bytes.
struct HelloMessage {
  std::uint32_t pid = 0;
  std::string host;
};
struct AssignMessage {
  RunList runs;
};
/// units:   nanoseconds; start_ns since the sender began its render phase
struct ResultMessage {
  TaskId task{};
  std::uint64_t start_ns = 0;
  std::uint64_t busy_ns = 0;
  std::span<const std::byte> payload;  ///< decoded: lies in the message's bytes
};
struct StopMessage {};
/// Bytes that are no message of this protocol.
struct Malformed {
  std::string_view problem;  ///< for a person, "its length does not fit its kind"
};
using Message = std::variant<Malformed, HelloMessage, AssignMessage, ResultMessage, StopMessage>;

Bytes encode(const HelloMessage& hello);
/// shapes:  1 to 3 runs, none of them empty
Bytes encode(const AssignMessage& assign);
/// Puts the header in front of `payload`, whose memory is used where it has room; `result.payload` is not looked at.
Bytes encode(const ResultMessage& result, Bytes&& payload);
Bytes encode(const StopMessage& stop);

/// throws:  never, but for a lack of memory
Message decode(std::span<const std::byte> bytes);

}  // namespace tessera::scheduler
