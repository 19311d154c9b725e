// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/message.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "scheduler/checksum.h"

namespace tessera::scheduler {
namespace {

static_assert(std::endian::native == std::endian::little, "messages are written in the host's byte order");

using Kind = std::array<char, 4>;
constexpr Kind kHello{'H', 'E', 'L', 'O'};
constexpr Kind kAssign{'A', 'S', 'G', 'N'};
constexpr Kind kResult{'R', 'S', 'L', 'T'};
constexpr Kind kBack{'B', 'A', 'C', 'K'};
constexpr Kind kReturn{'R', 'E', 'T', 'N'};
constexpr Kind kAlive{'A', 'L', 'I', 'V'};
constexpr Kind kStop{'S', 'T', 'O', 'P'};
constexpr Kind kBye{'B', 'Y', 'E', ' '};

struct WireHello {
  Kind kind = kHello;
  std::uint32_t version = kProtocolVersion;
  std::uint32_t pid = 0;
  std::array<char, 52> host{};  // ends with at least one 0, and nothing but 0 follows
};

struct WireRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// An assignment or what is returned.
struct WireRuns {
  Kind kind{};
  std::uint32_t run_count = 0;
  std::array<WireRun, RunList::kCapacity> runs{};  // those beyond run_count are 0
};

struct WireResult {
  Kind kind = kResult;
  std::uint32_t task = 0;
  std::uint64_t start_ns = 0;
  std::uint64_t busy_ns = 0;
  std::uint64_t checksum = 0;  ///< of all that comes before it and of the payload
};

struct WireBack {
  Kind kind = kBack;
  std::uint32_t tasks = 0;
};

/// A message that is nothing but its kind.
struct WireSign {
  Kind kind{};
};

template <class Wire>
constexpr bool is_plain = std::is_trivially_copyable_v<Wire>&& std::has_unique_object_representations_v<Wire>;
static_assert(is_plain<WireHello> && sizeof(WireHello) == kHelloBytes);
static_assert(is_plain<WireRuns> && sizeof(WireRuns) == kAssignBytes && sizeof(WireRuns) == kReturnBytes);
static_assert(is_plain<WireResult> && sizeof(WireResult) == kResultHeaderBytes);
static_assert(is_plain<WireBack> && sizeof(WireBack) == kBackBytes);
static_assert(is_plain<WireSign> && sizeof(WireSign) == kSignBytes);

template <class Wire>
Bytes to_bytes(const Wire& wire) {
  const auto bytes = std::as_bytes(std::span(&wire, 1));
  return Bytes(bytes.begin(), bytes.end());
}

template <class Wire>
Wire from_bytes(std::span<const std::byte> bytes) {
  Wire wire;
  std::memcpy(&wire, bytes.data(), sizeof wire);
  return wire;
}

Message decode_hello(std::span<const std::byte> bytes) {
  const auto wire = from_bytes<WireHello>(bytes);
  if (wire.version != kProtocolVersion) return Malformed{"it speaks another version of the protocol"};
  const auto end = std::find(wire.host.begin(), wire.host.end(), '\0');
  if (end == wire.host.end() || std::any_of(end, wire.host.end(), [](char c) { return c != '\0'; })) {
    return Malformed{"its host name does not end"};
  }
  return HelloMessage{wire.pid, std::string(wire.host.begin(), end)};
}

/// The runs of an assignment or of what is returned, or what is wrong with them.
std::variant<RunList, Malformed> decode_runs(std::span<const std::byte> bytes) {
  const auto wire = from_bytes<WireRuns>(bytes);
  if (wire.run_count > RunList::kCapacity) return Malformed{"its number of runs is out of range"};
  RunList runs;
  for (std::uint32_t i = 0; i < wire.runs.size(); ++i) {
    const WireRun& run = wire.runs[i];
    if (i >= wire.run_count) {
      if (run.first != 0 || run.count != 0) return Malformed{"there is something where a run is unused"};
      continue;
    }
    if (run.count == 0) return Malformed{"it has an empty run"};
    if (run.count - 1 > std::numeric_limits<std::uint32_t>::max() - run.first) {
      return Malformed{"a run goes past the last task number"};
    }
    runs.push(TaskRun{TaskId{run.first}, run.count});
  }
  return runs;
}

Message decode_assign(std::span<const std::byte> bytes) {
  const auto runs = decode_runs(bytes);
  if (const auto* malformed = std::get_if<Malformed>(&runs)) return *malformed;
  if (std::get<RunList>(runs).empty()) return Malformed{"it assigns nothing"};
  return AssignMessage{std::get<RunList>(runs)};
}

Message decode_return(std::span<const std::byte> bytes) {
  const auto runs = decode_runs(bytes);
  if (const auto* malformed = std::get_if<Malformed>(&runs)) return *malformed;
  return ReturnMessage{std::get<RunList>(runs)};
}

std::uint64_t checksum_of(const WireResult& wire, std::span<const std::byte> payload) {
  constexpr std::size_t kCovered = offsetof(WireResult, checksum);
  return checksum(payload, checksum(std::as_bytes(std::span(&wire, 1)).first(kCovered)));
}

Message decode_result(std::span<const std::byte> bytes) {
  const auto wire = from_bytes<WireResult>(bytes);
  const auto payload = bytes.subspan(sizeof wire);
  if (checksum_of(wire, payload) != wire.checksum) return DamagedMessage{TaskId{wire.task}};
  return ResultMessage{TaskId{wire.task}, wire.start_ns, wire.busy_ns, payload};
}

Message decode_back(std::span<const std::byte> bytes) {
  const auto wire = from_bytes<WireBack>(bytes);
  if (wire.tasks == 0) return Malformed{"it asks for nothing back"};
  return BackMessage{wire.tasks};
}

Bytes encode_runs(Kind kind, const RunList& runs) {
  WireRuns wire;
  wire.kind = kind;
  for (const TaskRun& run : runs) wire.runs[wire.run_count++] = {index_of(run.first), run.count};
  return to_bytes(wire);
}

}  // namespace

Bytes encode(const HelloMessage& hello) {
  WireHello wire;
  wire.pid = hello.pid;
  std::copy_n(hello.host.begin(), std::min(hello.host.size(), wire.host.size() - 1), wire.host.begin());
  return to_bytes(wire);
}

Bytes encode(const AssignMessage& assign) {
  assert(!assign.runs.empty());
  return encode_runs(kAssign, assign.runs);
}

std::array<std::byte, kResultHeaderBytes> encode_header(const ResultMessage& result) {
  WireResult wire;
  wire.task = index_of(result.task);
  wire.start_ns = result.start_ns;
  wire.busy_ns = result.busy_ns;
  wire.checksum = checksum_of(wire, result.payload);
  return std::bit_cast<std::array<std::byte, kResultHeaderBytes>>(wire);
}

Bytes encode(const BackMessage& back) {
  assert(back.tasks > 0);
  return to_bytes(WireBack{kBack, back.tasks});
}

Bytes encode(const ReturnMessage& returned) {
  return encode_runs(kReturn, returned.runs);
}

Bytes encode(AliveMessage) {
  return to_bytes(WireSign{kAlive});
}

Bytes encode(StopMessage) {
  return to_bytes(WireSign{kStop});
}

Bytes encode(ByeMessage) {
  return to_bytes(WireSign{kBye});
}

Message decode(std::span<const std::byte> bytes) {
  constexpr Malformed kWrongLength{"its length does not fit its kind"};
  Kind kind;
  if (bytes.size() < kind.size()) return Malformed{"it is too short to have a kind"};
  std::memcpy(kind.data(), bytes.data(), kind.size());
  if (kind == kHello) return bytes.size() == kHelloBytes ? decode_hello(bytes) : kWrongLength;
  if (kind == kAssign) return bytes.size() == kAssignBytes ? decode_assign(bytes) : kWrongLength;
  if (kind == kResult) return bytes.size() >= kResultHeaderBytes ? decode_result(bytes) : kWrongLength;
  if (kind == kBack) return bytes.size() == kBackBytes ? decode_back(bytes) : kWrongLength;
  if (kind == kReturn) return bytes.size() == kReturnBytes ? decode_return(bytes) : kWrongLength;
  if (bytes.size() != kSignBytes) return kWrongLength;
  if (kind == kAlive) return AliveMessage{};
  if (kind == kStop) return StopMessage{};
  if (kind == kBye) return ByeMessage{};
  return Malformed{"it is of no known kind"};
}

}  // namespace tessera::scheduler
