// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/message.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace tessera::scheduler {
namespace {

Bytes hello() {
  return encode(HelloMessage{4711, "node17"});
}

Bytes assign() {
  RunList runs;
  runs.push(TaskRun{TaskId{12}, 3});
  runs.push(TaskRun{TaskId{0xffffffff}, 1});
  return encode(AssignMessage{runs});
}

Bytes result() {
  return encode(ResultMessage{TaskId{9}, 1, 2, {}}, Bytes());
}

Bytes stop() {
  return encode(StopMessage{});
}

bool is_malformed(std::span<const std::byte> bytes) {
  return std::holds_alternative<Malformed>(decode(bytes));
}

// A message with one 32-bit field replaced.
Bytes with_field(Bytes bytes, std::size_t offset, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes.at(offset + i) = static_cast<std::byte>(value >> (8 * i));
  return bytes;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(message)

BOOST_AUTO_TEST_CASE(hello_comes_back) {
  const auto decoded = std::get<HelloMessage>(decode(hello()));
  BOOST_TEST(decoded.pid == 4711U);
  BOOST_TEST(decoded.host == "node17");
}

BOOST_AUTO_TEST_CASE(a_long_host_name_is_cut) {
  const std::string name(300, 'x');
  BOOST_TEST(std::get<HelloMessage>(decode(encode(HelloMessage{1, name}))).host == name.substr(0, 51));
}

BOOST_AUTO_TEST_CASE(assign_comes_back) {
  const auto decoded = std::get<AssignMessage>(decode(assign()));
  BOOST_REQUIRE_EQUAL(decoded.runs.size(), 2U);
  BOOST_TEST((decoded.runs.begin()[0] == TaskRun{TaskId{12}, 3}));
  BOOST_TEST((decoded.runs.begin()[1] == TaskRun{TaskId{0xffffffff}, 1}));
}

BOOST_AUTO_TEST_CASE(result_comes_back_with_its_payload) {
  for (const std::size_t size : {0U, 1U, 3072U}) {
    Bytes payload(size);
    for (std::size_t i = 0; i < size; ++i) payload[i] = static_cast<std::byte>(i * 7);
    const Bytes bytes = encode(ResultMessage{TaskId{5}, 123456789012345, 42, {}}, Bytes(payload));
    BOOST_TEST(bytes.size() == kResultHeaderBytes + size);
    const auto decoded = std::get<ResultMessage>(decode(bytes));
    BOOST_TEST(index_of(decoded.task) == 5U);
    BOOST_TEST(decoded.start_ns == 123456789012345U);
    BOOST_TEST(decoded.busy_ns == 42U);
    BOOST_TEST((Bytes(decoded.payload.begin(), decoded.payload.end()) == payload));
    BOOST_TEST((size == 0 || decoded.payload.data() == bytes.data() + kResultHeaderBytes));
  }
}

BOOST_AUTO_TEST_CASE(stop_comes_back) {
  BOOST_TEST(std::holds_alternative<StopMessage>(decode(stop())));
}

BOOST_AUTO_TEST_CASE(sizes_are_those_of_the_protocol) {
  BOOST_TEST(hello().size() == 64U);
  BOOST_TEST(assign().size() == 32U);
  BOOST_TEST(result().size() == 24U);
  BOOST_TEST(stop().size() == 4U);
}

BOOST_AUTO_TEST_CASE(fields_are_little_endian) {
  const Bytes bytes = encode(ResultMessage{TaskId{0x01020304}, 0x1122, 0, {}}, Bytes());
  BOOST_TEST(std::to_integer<char>(bytes[0]) == 'R');
  BOOST_TEST(std::to_integer<int>(bytes[4]) == 4);
  BOOST_TEST(std::to_integer<int>(bytes[7]) == 1);
  BOOST_TEST(std::to_integer<int>(bytes[8]) == 0x22);
}

BOOST_AUTO_TEST_CASE(every_prefix_is_rejected) {
  for (const Bytes& whole : {hello(), assign(), result(), stop()}) {
    for (std::size_t length = 0; length < whole.size(); ++length) {
      BOOST_TEST(is_malformed(std::span(whole).first(length)), "a prefix of " << length << " of " << whole.size());
    }
  }
}

BOOST_AUTO_TEST_CASE(trailing_bytes_are_rejected_except_for_a_payload) {
  for (Bytes bytes : {hello(), assign(), stop()}) {
    for (int extra = 0; extra < 40; ++extra) {
      bytes.push_back(std::byte{0});
      BOOST_TEST(is_malformed(bytes));
    }
  }
}

BOOST_AUTO_TEST_CASE(another_kind_is_rejected) {
  // Each with the kind of each other: none has the other's length, but a result takes any length and is told by its
  // kind.
  const std::vector<Bytes> all{hello(), assign(), result(), stop()};
  for (const Bytes& body : all) {
    for (const Bytes& kind : all) {
      if (body.size() == kind.size() || kind.size() == kResultHeaderBytes) continue;
      Bytes mixed = body;
      std::copy_n(kind.begin(), 4, mixed.begin());
      BOOST_TEST(is_malformed(mixed));
    }
    BOOST_TEST(is_malformed(with_field(body, 0, 0)));
    BOOST_TEST(is_malformed(with_field(body, 0, 0x41414141)));
  }
}

BOOST_AUTO_TEST_CASE(another_version_is_rejected_by_name) {
  for (const std::uint32_t version : {0U, kProtocolVersion + 1, 0xffffffffU}) {
    const Message decoded = decode(with_field(hello(), 4, version));
    BOOST_REQUIRE(std::holds_alternative<Malformed>(decoded));
    BOOST_TEST(std::get<Malformed>(decoded).problem.find("version") != std::string_view::npos);
  }
}

BOOST_AUTO_TEST_CASE(a_host_name_must_end_and_be_followed_by_nothing) {
  Bytes bytes = encode(HelloMessage{1, std::string(51, 'x')});
  BOOST_TEST(!is_malformed(bytes));
  bytes.back() = std::byte{'x'};
  BOOST_TEST(is_malformed(bytes));
  bytes = hello();
  bytes.back() = std::byte{'x'};
  BOOST_TEST(is_malformed(bytes));
}

BOOST_AUTO_TEST_CASE(runs_must_make_sense) {
  BOOST_TEST(is_malformed(with_field(assign(), 4, 0)));             // no run
  BOOST_TEST(is_malformed(with_field(assign(), 4, 4)));             // more than there is room for
  BOOST_TEST(is_malformed(with_field(assign(), 4, 1)));             // the second run is there but not counted
  BOOST_TEST(is_malformed(with_field(assign(), 4, 3)));             // the third is counted but empty
  BOOST_TEST(is_malformed(with_field(assign(), 12, 0)));            // an empty run
  BOOST_TEST(is_malformed(with_field(assign(), 20, 2)));            // past the last task number
  BOOST_TEST(is_malformed(with_field(assign(), 24, 1)));            // an unused run is not 0
  BOOST_TEST(!is_malformed(with_field(assign(), 12, 0xfffffff4)));  // to the last task number exactly
}

BOOST_AUTO_TEST_CASE(random_junk_is_rejected) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 20000; ++trial) {
    Bytes junk(random() % 100);
    for (std::byte& byte : junk) byte = static_cast<std::byte>(random());
    BOOST_TEST(is_malformed(junk));
  }
}

BOOST_AUTO_TEST_CASE(junk_behind_a_good_kind_decodes_to_something_sane_or_nothing) {
  std::mt19937_64 random(2);
  for (const Bytes& whole : {hello(), assign()}) {
    for (int trial = 0; trial < 20000; ++trial) {
      Bytes bytes = whole;
      for (int flips = 0; flips < 3; ++flips) {
        bytes[4 + random() % (bytes.size() - 4)] = static_cast<std::byte>(random() % 4 == 0 ? 0 : random());
      }
      const Message decoded = decode(bytes);
      if (const auto* hi = std::get_if<HelloMessage>(&decoded)) {
        BOOST_TEST(hi->host.find('\0') == std::string::npos);
        BOOST_TEST((encode(*hi) == bytes));
      } else if (const auto* work = std::get_if<AssignMessage>(&decoded)) {
        BOOST_TEST(!work->runs.empty());
        BOOST_TEST((encode(*work) == bytes));
      } else {
        BOOST_TEST(std::holds_alternative<Malformed>(decoded));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
