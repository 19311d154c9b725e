// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/loopback.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace tessera::scheduler {
namespace {

constexpr std::uint32_t kRanks = 4;
constexpr std::uint8_t kMessages = 20;

using Delivery = std::pair<Rank, std::uint8_t>;  // source, number within the source

// Every rank but the last sends its numbered messages to the last one; what arrives there, in order.
std::vector<Delivery> deliveries(std::uint64_t seed) {
  LoopbackNetwork network(kRanks, seed);
  for (std::uint8_t number = 0; number < kMessages; ++number) {
    for (Rank rank = 0; rank + 1 < kRanks; ++rank) {
      network.transport(rank).send(kRanks - 1, Bytes{std::byte{number}});
    }
  }
  std::vector<Delivery> arrived;
  while (arrived.size() < std::size_t{kMessages} * (kRanks - 1)) {
    const auto envelope = network.transport(kRanks - 1).receive();
    if (envelope) arrived.emplace_back(envelope->source, std::to_integer<std::uint8_t>(envelope->bytes[0]));
  }
  return arrived;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(loopback_network)

BOOST_AUTO_TEST_CASE(each_message_arrives_once) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const std::vector<Delivery> arrived = deliveries(seed);
    BOOST_TEST(std::set<Delivery>(arrived.begin(), arrived.end()).size() == arrived.size());
  }
}

BOOST_AUTO_TEST_CASE(a_message_may_pass_an_earlier_one_of_the_same_rank) {
  const std::vector<Delivery> arrived = deliveries(1);
  std::vector<std::uint8_t> of_first;
  for (const auto& [source, number] : arrived) {
    if (source == 0) of_first.push_back(number);
  }
  BOOST_TEST(!std::is_sorted(of_first.begin(), of_first.end()));
}

BOOST_AUTO_TEST_CASE(both_parts_of_a_message_arrive_as_one) {
  LoopbackNetwork network(2, 0);
  network.transport(0).send(1, Bytes{std::byte{1}, std::byte{2}}, Bytes{std::byte{3}});
  std::optional<Envelope> envelope;
  while (!envelope) envelope = network.transport(1).receive();
  const Bytes arrived(envelope->bytes.begin(), envelope->bytes.end());
  BOOST_TEST((arrived == Bytes{std::byte{1}, std::byte{2}, std::byte{3}}));
}

BOOST_AUTO_TEST_CASE(equal_seeds_deliver_alike) {
  BOOST_TEST((deliveries(7) == deliveries(7)));
}

BOOST_AUTO_TEST_CASE(different_seeds_mix_the_sources_differently) {
  std::set<std::vector<Delivery>> histories;
  for (std::uint64_t seed = 0; seed < 20; ++seed) histories.insert(deliveries(seed));
  BOOST_TEST(histories.size() == 20U);
}

BOOST_AUTO_TEST_CASE(a_message_may_still_be_on_its_way) {
  int late = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    LoopbackNetwork network(2, seed);
    network.transport(0).send(1, Bytes(1));
    if (!network.transport(1).receive()) ++late;
  }
  BOOST_TEST(late > 0);
  BOOST_TEST(late < 100);
}

BOOST_AUTO_TEST_CASE(both_ends_count_messages_and_bytes) {
  LoopbackNetwork network(2, 0);
  network.transport(0).send(1, Bytes(5));
  network.transport(0).send(1, Bytes());
  int arrived = 0;
  while (arrived < 2) arrived += network.transport(1).receive().has_value() ? 1 : 0;
  BOOST_TEST((network.transport(0).sent() == Traffic{2, 5}));
  BOOST_TEST((network.transport(1).received() == Traffic{2, 5}));
  BOOST_TEST((network.transport(0).received() == Traffic{}));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
