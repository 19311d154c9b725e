// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/message.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "scheduler/by_hand.h"

namespace tessera::scheduler {
namespace {

RunList two_runs() {
  RunList runs;
  runs.push(TaskRun{TaskId{12}, 3});
  runs.push(TaskRun{TaskId{0xffffffff}, 1});
  return runs;
}

Bytes hello() {
  return encode(HelloMessage{4711, "node17"});
}

Bytes assign() {
  return encode(AssignMessage{two_runs()});
}

Bytes result() {
  return encode_whole(ResultMessage{TaskId{9}, 1, 2, {}}, Bytes());
}

Bytes back() {
  return encode(BackMessage{5});
}

Bytes returned() {
  return encode(ReturnMessage{two_runs()});
}

Bytes alive() {
  return encode(AliveMessage{});
}

Bytes stop() {
  return encode(StopMessage{});
}

Bytes bye() {
  return encode(ByeMessage{});
}

std::vector<Bytes> one_of_each() {
  return {hello(), assign(), result(), back(), returned(), alive(), stop(), bye()};
}

bool is_malformed(std::span<const std::byte> bytes) {
  return std::holds_alternative<Malformed>(decode(bytes));
}

std::string in_hex(std::span<const std::byte> bytes) {
  std::string hex;
  for (const std::byte byte : bytes) {
    hex += "0123456789abcdef"[std::to_integer<unsigned>(byte) / 16];
    hex += "0123456789abcdef"[std::to_integer<unsigned>(byte) % 16];
  }
  return hex;
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
    const Bytes bytes = encode_whole(ResultMessage{TaskId{5}, 123456789012345, 42, {}}, Bytes(payload));
    BOOST_TEST(bytes.size() == kResultHeaderBytes + size);
    const auto decoded = std::get<ResultMessage>(decode(bytes));
    BOOST_TEST(index_of(decoded.task) == 5U);
    BOOST_TEST(decoded.start_ns == 123456789012345U);
    BOOST_TEST(decoded.busy_ns == 42U);
    BOOST_TEST((Bytes(decoded.payload.begin(), decoded.payload.end()) == payload));
    BOOST_TEST((size == 0 || decoded.payload.data() == bytes.data() + kResultHeaderBytes));
  }
}

BOOST_AUTO_TEST_CASE(what_is_asked_back_comes_back) {
  for (const std::uint32_t tasks : {1U, 5U, 0xffffffffU}) {
    BOOST_TEST(std::get<BackMessage>(decode(encode(BackMessage{tasks}))).tasks == tasks);
  }
  BOOST_TEST(is_malformed(with_field(back(), 4, 0)));
}

BOOST_AUTO_TEST_CASE(what_is_returned_comes_back_be_it_nothing) {
  BOOST_TEST((std::get<ReturnMessage>(decode(returned())).runs == two_runs()));
  BOOST_TEST(std::get<ReturnMessage>(decode(encode(ReturnMessage{}))).runs.empty());
}

BOOST_AUTO_TEST_CASE(messages_that_are_nothing_but_their_kind_come_back) {
  BOOST_TEST(std::holds_alternative<AliveMessage>(decode(alive())));
  BOOST_TEST(std::holds_alternative<StopMessage>(decode(stop())));
  BOOST_TEST(std::holds_alternative<ByeMessage>(decode(bye())));
}

BOOST_AUTO_TEST_CASE(each_message_has_its_own_bytes) {
  // Written out once: a change here is another version of the protocol.
  BOOST_TEST(in_hex(hello()) ==
             "48454c4f"
             "02000000"
             "67120000"
             "6e6f64653137" +
                 std::string(92, '0'));
  BOOST_TEST(in_hex(assign()) ==
             "4153474e"
             "02000000"
             "0c000000"
             "03000000"
             "ffffffff"
             "01000000"
             "0000000000000000");
  BOOST_TEST(in_hex(back()) ==
             "4241434b"
             "05000000");
  BOOST_TEST(in_hex(returned()) ==
             "5245544e"
             "02000000"
             "0c000000"
             "03000000"
             "ffffffff"
             "01000000"
             "0000000000000000");
  BOOST_TEST(in_hex(alive()) == "414c4956");
  BOOST_TEST(in_hex(stop()) == "53544f50");
  BOOST_TEST(in_hex(bye()) == "42594520");
  const Bytes delivered = encode_whole(ResultMessage{TaskId{0x01020304}, 0x1122, 0x3344, {}}, Bytes{std::byte{0xab}});
  BOOST_TEST(in_hex(delivered) ==
             "52534c54"
             "04030201"
             "2211000000000000"
             "4433000000000000"
             "a51d4d4a4755ec37"
             "ab");
}

BOOST_AUTO_TEST_CASE(every_prefix_is_rejected) {
  for (const Bytes& whole : one_of_each()) {
    for (std::size_t length = 0; length < whole.size(); ++length) {
      BOOST_TEST(is_malformed(std::span(whole).first(length)), "a prefix of " << length << " of " << whole.size());
    }
  }
}

BOOST_AUTO_TEST_CASE(trailing_bytes_are_rejected_except_for_a_payload) {
  for (Bytes bytes : one_of_each()) {
    if (bytes == result()) continue;
    for (int extra = 0; extra < 40; ++extra) {
      bytes.push_back(std::byte{0});
      BOOST_TEST(is_malformed(bytes));
    }
  }
}

BOOST_AUTO_TEST_CASE(another_kind_is_rejected) {
  // Each with the kind of each other that has not its length. A result takes any length, but not any checksum.
  for (const Bytes& body : one_of_each()) {
    for (const Bytes& kind : one_of_each()) {
      if (body.size() == kind.size()) continue;
      Bytes mixed = body;
      std::copy_n(kind.begin(), 4, mixed.begin());
      const Message decoded = decode(mixed);
      BOOST_TEST((std::holds_alternative<Malformed>(decoded) || std::holds_alternative<DamagedMessage>(decoded)));
      if (mixed.size() < kResultHeaderBytes) BOOST_TEST(std::holds_alternative<Malformed>(decoded));
    }
    BOOST_TEST(is_malformed(with_field(body, 0, 0)));
    BOOST_TEST(is_malformed(with_field(body, 0, 0x41414141)));
  }
}

BOOST_AUTO_TEST_CASE(each_flipped_bit_of_a_result_is_found) {
  for (const std::size_t size : {0U, 1U, 3U, 100U, 3072U}) {
    const Bytes whole = encode_whole(ResultMessage{TaskId{5}, 123456789012345, 42, {}}, Bytes(size, std::byte{0x5a}));
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
      Bytes bytes = whole;
      bytes[bit / 8] ^= std::byte{static_cast<unsigned char>(1U << (bit % 8))};
      const Message decoded = decode(bytes);
      if (bit < 32) {
        BOOST_REQUIRE_MESSAGE(std::holds_alternative<Malformed>(decoded), "bit " << bit << " of the kind");
        continue;
      }
      BOOST_REQUIRE_MESSAGE(std::holds_alternative<DamagedMessage>(decoded), "bit " << bit << " of " << size);
      const std::uint32_t said = bit < 64 ? 5U ^ (1U << (bit - 32)) : 5U;
      BOOST_REQUIRE_EQUAL(index_of(std::get<DamagedMessage>(decoded).task), said);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_result_of_another_length_is_damaged) {
  const Bytes whole = encode_whole(ResultMessage{TaskId{5}, 1, 2, {}}, Bytes(200, std::byte{0}));
  for (std::size_t length = kResultHeaderBytes; length < whole.size() + 50; ++length) {
    Bytes bytes = whole;
    bytes.resize(length);
    BOOST_TEST(std::holds_alternative<DamagedMessage>(decode(bytes)) == (length != whole.size()));
  }
}

BOOST_AUTO_TEST_CASE(the_payload_of_another_task_is_damaged) {
  // A header and a payload that are sound each, but not of one message.
  const Bytes one = encode_whole(ResultMessage{TaskId{1}, 10, 20, {}}, Bytes(64, std::byte{1}));
  Bytes mixed = encode_whole(ResultMessage{TaskId{2}, 10, 20, {}}, Bytes(64, std::byte{2}));
  std::copy(one.begin() + kResultHeaderBytes, one.end(), mixed.begin() + kResultHeaderBytes);
  BOOST_TEST(index_of(std::get<DamagedMessage>(decode(mixed)).task) == 2U);
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
  for (const Bytes& runs : {assign(), returned()}) {
    BOOST_TEST(is_malformed(with_field(runs, 4, 4)));             // more than there is room for
    BOOST_TEST(is_malformed(with_field(runs, 4, 0xffffffff)));    // the same
    BOOST_TEST(is_malformed(with_field(runs, 4, 0)));             // runs are there but not counted
    BOOST_TEST(is_malformed(with_field(runs, 4, 1)));             // the second run is there but not counted
    BOOST_TEST(is_malformed(with_field(runs, 4, 3)));             // the third is counted but empty
    BOOST_TEST(is_malformed(with_field(runs, 12, 0)));            // an empty run
    BOOST_TEST(is_malformed(with_field(runs, 20, 2)));            // past the last task number
    BOOST_TEST(is_malformed(with_field(runs, 24, 1)));            // an unused run is not 0
    BOOST_TEST(!is_malformed(with_field(runs, 12, 0xfffffff4)));  // to the last task number exactly
  }
  // To assign nothing is no assignment
  Bytes nothing = encode(ReturnMessage{});
  BOOST_TEST(!is_malformed(nothing));
  const Bytes kind = assign();
  std::copy_n(kind.begin(), 4, nothing.begin());
  BOOST_TEST(is_malformed(nothing));
}

BOOST_AUTO_TEST_CASE(junk_of_any_length_behind_any_kind_is_survived) {
  std::mt19937_64 random(3);
  for (const Bytes& message : one_of_each()) {
    for (int trial = 0; trial < 5000; ++trial) {
      Bytes junk(4 + random() % 100);
      for (std::byte& byte : junk) byte = static_cast<std::byte>(random());
      std::copy_n(message.begin(), 4, junk.begin());
      const Message decoded = decode(junk);
      BOOST_TEST(!std::holds_alternative<ResultMessage>(decoded));
      if (junk.size() != message.size() && message != result()) BOOST_TEST(is_malformed(junk));
    }
  }
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
  for (const Bytes& whole : {hello(), assign(), back(), returned(), result()}) {
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
      } else if (const auto* asked = std::get_if<BackMessage>(&decoded)) {
        BOOST_TEST((encode(*asked) == bytes));
      } else if (const auto* given = std::get_if<ReturnMessage>(&decoded)) {
        BOOST_TEST((encode(*given) == bytes));
      } else if (std::holds_alternative<ResultMessage>(decoded)) {
        BOOST_TEST((bytes == whole));  // nothing was changed
      } else if (std::holds_alternative<DamagedMessage>(decoded)) {
        BOOST_TEST(bytes.size() >= kResultHeaderBytes);
      } else {
        BOOST_TEST(std::holds_alternative<Malformed>(decoded));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
