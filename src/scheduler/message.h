// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "scheduler/bytes.h"
#include "scheduler/task.h"

// The messages of the protocol and their bytes. Every field has a fixed width and is little-endian; a message begins
// with four letters that say its kind. Decoding takes nothing on trust. Nothing is wrong where messages overtake each
// other.
//
//   HELO  64 B  worker -> master  version, pid, host                "I am here"
//   ASGN  32 B  master -> worker  1 to 3 runs of tasks              "do these, after what you have"
//   RSLT  32 B  worker -> master  task, times, checksum, payload    "this is done, give me more"
//   BACK   8 B  master -> worker  a number of tasks                 "give back what you have not begun"
//   RETN  32 B  worker -> master  up to 3 runs of tasks             "these, then"
//   ALIV   4 B  worker -> master                                    "I am at work"
//   STOP   4 B  master -> worker                                    "go home"
//   BYE    4 B  worker -> master                                    "I go"
namespace tessera::scheduler {

inline constexpr std::uint32_t kProtocolVersion = 2;

inline constexpr std::size_t kHelloBytes = 64;
inline constexpr std::size_t kAssignBytes = 32;
inline constexpr std::size_t kResultHeaderBytes = 32;  ///< the payload follows
inline constexpr std::size_t kBackBytes = 8;
inline constexpr std::size_t kReturnBytes = 32;
inline constexpr std::size_t kSignBytes = 4;  ///< of messages that are nothing but their kind

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
/// A result whose checksum does not fit.
struct DamagedMessage {
  TaskId task{};  ///< as the message says
};
struct BackMessage {
  std::uint32_t tasks = 0;
};
struct ReturnMessage {
  RunList runs;
};
struct AliveMessage {};
struct StopMessage {};
struct ByeMessage {};
/// Bytes that are no message of this protocol.
struct Malformed {
  std::string_view problem;  ///< for a person, "its length does not fit its kind"
};
using Message = std::variant<Malformed, HelloMessage, AssignMessage, ResultMessage, DamagedMessage, BackMessage,
                             ReturnMessage, AliveMessage, StopMessage, ByeMessage>;

Bytes encode(const HelloMessage& hello);
/// shapes:  1 to 3 runs, none of them empty
Bytes encode(const AssignMessage& assign);
/// The message is these bytes and, behind them, the payload.
std::array<std::byte, kResultHeaderBytes> encode_header(const ResultMessage& result);
/// shapes:  at least one task
Bytes encode(const BackMessage& back);
/// shapes:  0 to 3 runs, none of them empty
Bytes encode(const ReturnMessage& returned);
Bytes encode(AliveMessage);
Bytes encode(StopMessage);
Bytes encode(ByeMessage);

/// throws:  never, but for a lack of memory
Message decode(std::span<const std::byte> bytes);

}  // namespace tessera::scheduler
