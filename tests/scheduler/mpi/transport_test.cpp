// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/transport.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cstring>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "scheduler/backoff.h"
#include "scheduler/mpi/session_for_tests.h"

namespace tessera::scheduler::mpi {
namespace {

constexpr std::uint32_t kMessages = 60;

// Small and large ones, which travel in another way, in turn, and those next to the length that parts them.
std::size_t size_of(std::uint32_t number) {
  constexpr std::size_t kSizes[] = {4, 100'000, 5, 2000, 1'000'000, kShortBytes - 1, kShortBytes, kShortBytes + 1};
  return kSizes[number % std::size(kSizes)];
}

Bytes message_with(std::uint32_t number) {
  Bytes bytes(size_of(number), static_cast<std::byte>(number));
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

Envelope wait_for_message(Transport& transport) {
  Backoff backoff(Patience::yield_only);
  for (;;) {
    if (const auto envelope = transport.receive()) return *envelope;
    backoff.wait();
  }
}

bool is_equal(std::span<const std::byte> a, const Bytes& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

// The number that message_with wrote.
std::uint32_t number_of(std::span<const std::byte> bytes) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data(), sizeof number);
  return number;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(mpi_transport)

BOOST_AUTO_TEST_CASE(messages_of_all_sizes_arrive_once) {
  Session& session = session_for_tests();
  MpiTransport transport(session);
  if (session.rank() != kMasterRank) {
    for (std::uint32_t number = 0; number < kMessages; ++number) transport.send(kMasterRank, message_with(number));
    transport.flush();
  } else {
    std::vector<std::set<std::uint32_t>> arrived(session.size());
    std::uint64_t bytes = 0;
    for (std::uint32_t i = 0; i < kMessages * (session.size() - 1); ++i) {
      const Envelope envelope = wait_for_message(transport);
      const std::uint32_t number = number_of(envelope.bytes);
      BOOST_TEST(is_equal(envelope.bytes, message_with(number)));
      BOOST_TEST(number < kMessages);
      BOOST_TEST(arrived.at(envelope.source).insert(number).second);
      bytes += envelope.bytes.size();
    }
    BOOST_TEST(!transport.receive().has_value());
    BOOST_TEST((transport.received() == Traffic{kMessages * (session.size() - 1), bytes}));
  }
  session.barrier();
}

BOOST_AUTO_TEST_CASE(more_messages_than_there_are_receives_posted_arrive) {
  constexpr std::uint32_t kMany = 1000;
  Session& session = session_for_tests();
  MpiTransport transport(session);
  if (session.rank() != kMasterRank) {
    for (std::uint32_t number = 0; number < kMany; ++number) {
      transport.send(kMasterRank, std::as_bytes(std::span(&number, 1)));
    }
  }
  session.barrier();
  if (session.rank() == kMasterRank) {
    std::vector<std::uint64_t> sums(session.size());
    for (std::uint32_t i = 0; i < kMany * (session.size() - 1); ++i) {
      const Envelope envelope = wait_for_message(transport);
      sums.at(envelope.source) += number_of(envelope.bytes);
    }
    for (Rank rank = 1; rank < session.size(); ++rank) BOOST_TEST(sums[rank] == kMany * (kMany - 1) / 2);
  } else {
    transport.flush();
  }
  session.barrier();
}

BOOST_AUTO_TEST_CASE(a_message_in_two_parts_arrives_as_one) {
  Session& session = session_for_tests();
  MpiTransport transport(session);
  for (const std::uint32_t number : {0U, 1U}) {
    const Bytes whole = message_with(number);
    if (session.rank() != kMasterRank) {
      transport.send(kMasterRank, std::span(whole).first(3), std::span(whole).subspan(3));
      transport.flush();
    } else {
      for (Rank rank = 1; rank < session.size(); ++rank) {
        BOOST_TEST(is_equal(wait_for_message(transport).bytes, whole));
      }
    }
    session.barrier();
  }
}

BOOST_AUTO_TEST_CASE(a_transport_takes_no_message_of_the_next_one) {
  // The others send with the next one while rank 0 still has the last one, whose receives are posted.
  Session& session = session_for_tests();
  for (std::uint32_t number = 0; number < 20; ++number) {
    MpiTransport transport(session);
    if (session.rank() != kMasterRank) {
      transport.send(kMasterRank, message_with(number));
      transport.flush();
    } else {
      for (Rank rank = 1; rank < session.size(); ++rank) {
        BOOST_TEST(is_equal(wait_for_message(transport).bytes, message_with(number)));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
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
    BOOST_TEST(is_equal(wait_for_message(transport).bytes, message_with(4)));
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

BOOST_AUTO_TEST_CASE(an_abandoned_rank_is_not_waited_for) {
  // Rank 1 takes nothing before rank 0 is through with it.
  Session& session = session_for_tests();
  if (session.size() == 1) return;
  constexpr Rank kSilent = 1;
  MpiTransport transport(session);
  if (session.rank() == kMasterRank) {
    transport.send(kSilent, message_with(4));
    BOOST_TEST(!transport.try_flush());
    transport.abandon(kSilent);
    BOOST_TEST(transport.try_flush());
    for (Rank rank = 2; rank < session.size(); ++rank) transport.send(rank, message_with(4));
    transport.send(kSilent, message_with(1));
    transport.flush();
  } else if (session.rank() != kSilent) {
    BOOST_TEST(is_equal(wait_for_message(transport).bytes, message_with(4)));
  }
  session.barrier();
  if (session.rank() != kSilent) return session.barrier();
  for (int i = 0; i < 2; ++i) wait_for_message(transport);
  session.barrier();
}

BOOST_AUTO_TEST_CASE(a_large_message_that_never_comes_whole_keeps_no_other_waiting) {
  // The last rank announces messages and then moves none of them on, as if it had died.
  Session& session = session_for_tests();
  if (session.size() < 3) return;
  const Rank dying = session.size() - 1;
  constexpr std::uint32_t kDyingMessages = 100;
  MpiTransport transport(session);
  if (session.rank() == dying) {
    for (std::uint32_t i = 0; i < kDyingMessages; ++i) transport.send(kMasterRank, message_with(4));
  }
  session.barrier();
  if (session.rank() != kMasterRank && session.rank() != dying) {
    for (std::uint32_t number = 0; number < kMessages; ++number) transport.send(kMasterRank, message_with(number));
    transport.flush();
  }
  if (session.rank() == kMasterRank) {
    for (std::uint32_t left = kMessages * (session.size() - 2); left != 0;) {
      if (wait_for_message(transport).source != dying) --left;
    }
    transport.abandon(dying);
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
