// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/transport.h"

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include "scheduler/backoff.h"
#include "scheduler/mpi/session_for_tests.h"

namespace tessera::scheduler::mpi {
namespace {

constexpr std::uint32_t kMessages = 60;

// Small, empty and large ones (which MPI sends in another way) in turn.
std::size_t size_of(std::uint32_t number) {
  constexpr std::size_t kSizes[] = {4, 100'000, 4, 2000, 1'000'000};
  return kSizes[number % 5];
}

Bytes message_with(std::uint32_t number) {
  Bytes bytes(size_of(number), static_cast<std::byte>(number));
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

Envelope wait_for_message(Transport& transport) {
  Backoff backoff(Patience::yield_only);
  for (;;) {
    if (auto envelope = transport.receive()) return std::move(*envelope);
    backoff.wait();
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(mpi_transport)

BOOST_AUTO_TEST_CASE(messages_of_all_sizes_keep_their_order_between_two_ranks) {
  Session& session = session_for_tests();
  MpiTransport transport(session);
  if (session.rank() != kMasterRank) {
    for (std::uint32_t number = 0; number < kMessages; ++number) transport.send(kMasterRank, message_with(number));
    transport.flush();
  } else {
    std::vector<std::uint32_t> next(session.size(), 0);
    std::uint64_t bytes = 0;
    for (std::uint32_t i = 0; i < kMessages * (session.size() - 1); ++i) {
      const Envelope envelope = wait_for_message(transport);
      BOOST_TEST((envelope.bytes == message_with(next.at(envelope.source)++)));
      bytes += envelope.bytes.size();
    }
    BOOST_TEST(!transport.receive().has_value());
    BOOST_TEST((transport.received() == Traffic{kMessages * (session.size() - 1), bytes}));
  }
  session.barrier();
}

BOOST_AUTO_TEST_CASE(an_empty_message_arrives) {
  Session& session = session_for_tests();
  MpiTransport transport(session);
  if (session.rank() != kMasterRank) {
    transport.send(kMasterRank, Bytes());
    transport.flush();
  } else {
    for (Rank rank = 1; rank < session.size(); ++rank) BOOST_TEST(wait_for_message(transport).bytes.empty());
  }
  session.barrier();
}

BOOST_AUTO_TEST_CASE(an_exchange_in_both_directions_does_not_lock_up) {
  // Everybody sends a large message to everybody before looking at any.
  Session& session = session_for_tests();
  MpiTransport transport(session);
  for (Rank to = 0; to < session.size(); ++to) {
    if (to != session.rank()) transport.send(to, message_with(4));
  }
  for (Rank others = 1; others < session.size(); ++others) {
    BOOST_TEST((wait_for_message(transport).bytes == message_with(4)));
  }
  transport.flush();
  BOOST_TEST((transport.sent() == transport.received()));
  session.barrier();
}

BOOST_AUTO_TEST_CASE(flush_returns_when_a_large_message_has_left) {
  // It cannot leave before rank 0 asks for it, which happens this long after the others came to the barrier.
  constexpr std::chrono::milliseconds kLate{100};
  Session& session = session_for_tests();
  MpiTransport transport(session);
  const auto start = std::chrono::steady_clock::now();
  session.barrier();
  if (session.rank() != kMasterRank) {
    transport.send(kMasterRank, message_with(4));
    transport.flush();
    BOOST_TEST((std::chrono::steady_clock::now() - start >= kLate));
  } else {
    std::this_thread::sleep_for(kLate);
    for (Rank rank = 1; rank < session.size(); ++rank) wait_for_message(transport);
  }
  session.barrier();
}

BOOST_AUTO_TEST_CASE(a_rank_that_there_is_not_is_an_error_in_words) {
  Session& session = session_for_tests();
  MpiTransport transport(session);
  BOOST_CHECK_EXCEPTION(transport.send(session.size(), Bytes(4)), std::runtime_error, [](const auto& error) {
    return std::string_view(error.what()).starts_with("MPI_Isend failed (");
  });
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler::mpi
