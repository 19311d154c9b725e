// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/session.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <span>
#include <stdexcept>
#include <thread>

#include "scheduler/launcher.h"
#include "scheduler/mpi/session_for_tests.h"

namespace tessera::scheduler::mpi {
namespace {

Bytes pattern(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 31 + i / 1009);
  return bytes;
}

// Broadcasts so many bytes from rank 0, where the others have something else before.
bool arrives_everywhere(std::size_t size, std::size_t piece_bytes) {
  Session& session = session_for_tests();
  Bytes bytes = session.rank() == kMasterRank ? pattern(size) : Bytes(17, std::byte{1});
  session.broadcast(bytes, piece_bytes);
  return bytes == pattern(size);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(session)

BOOST_AUTO_TEST_CASE(the_launcher_and_mpi_agree) {
  const Session& session = session_for_tests();
  BOOST_TEST(launched_by_mpi());
  BOOST_TEST(launched_rank() == session.rank());
  BOOST_TEST(session.rank() < session.size());
}

BOOST_AUTO_TEST_CASE(all_ranks_of_a_test_are_on_one_node_or_in_parts_of_the_size_asked_for) {
  const Session& session = session_for_tests();
  const std::uint32_t most = std::min(most_ranks_on_node_in_tests(), session.size());
  BOOST_TEST(session.nodes() == (session.size() + most - 1) / most);
  BOOST_TEST(session.is_first_on_node() == (session.rank() % most == 0));
  const std::uint32_t first = session.rank() / most * most;
  BOOST_TEST(session.ranks_on_node() == std::min(most, session.size() - first));
}

BOOST_AUTO_TEST_CASE(a_broadcast_to_nodes_reaches_their_first_ranks_alone) {
  Session& session = session_for_tests();
  for (const std::size_t size : {0U, 1U, 12'345U}) {
    Bytes bytes = session.rank() == kMasterRank ? pattern(size) : Bytes(size, std::byte{255});
    session.broadcast_to_nodes(bytes, 1000);
    BOOST_TEST((bytes == (session.is_first_on_node() ? pattern(size) : Bytes(size, std::byte{255}))));
  }
}

BOOST_AUTO_TEST_CASE(a_broadcast_on_a_node_stays_there) {
  Session& session = session_for_tests();
  const std::uint32_t most = std::min(most_ranks_on_node_in_tests(), session.size());
  std::uint32_t first = session.is_first_on_node() ? session.rank() : 99;
  session.broadcast_on_node(std::as_writable_bytes(std::span(&first, 1)));
  BOOST_TEST(first == session.rank() / most * most);
}

BOOST_AUTO_TEST_CASE(more_ranks_than_cores_are_noticed) {
  const unsigned cores = std::thread::hardware_concurrency();
  if (session_for_tests().size() == 1) BOOST_TEST(!session_for_tests().is_oversubscribed());
  // Where the launcher does not bind, every rank sees every core.
  if (cores > 1) BOOST_TEST(session_for_tests().is_oversubscribed() == (session_for_tests().size() > cores));
}

BOOST_AUTO_TEST_CASE(the_library_says_its_name_in_a_few_words) {
  const std::string library = session_for_tests().library();
  BOOST_TEST(!library.empty());
  BOOST_TEST(library.size() < 40U);
  BOOST_TEST(library.find_first_of(",\n") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_broadcast_arrives_whatever_its_size) {
  constexpr std::size_t kDefaultPiece = std::size_t{1} << 28;
  for (const std::size_t size : {0U, 1U, 4095U, 4097U, 5'000'011U}) BOOST_TEST(arrives_everywhere(size, kDefaultPiece));
}

BOOST_AUTO_TEST_CASE(a_broadcast_arrives_in_pieces) {
  for (const std::size_t size : {0U, 1U, 999U, 1000U, 1001U, 2000U, 12345U}) BOOST_TEST(arrives_everywhere(size, 1000));
  BOOST_TEST(arrives_everywhere(100, 1));
  BOOST_TEST(arrives_everywhere(3'000'001, 1'000'000));
}

BOOST_AUTO_TEST_CASE(a_piece_that_mpi_cannot_count_is_refused) {
  Bytes bytes;
  BOOST_CHECK_THROW(session_for_tests().broadcast(bytes, 0), std::invalid_argument);
  BOOST_CHECK_THROW(session_for_tests().broadcast(bytes, std::size_t{1} << 31), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_barrier_holds_until_the_last_rank_has_come) {
  Session& session = session_for_tests();
  constexpr std::chrono::milliseconds kLate{50};
  session.barrier();
  const auto start = std::chrono::steady_clock::now();
  if (session.rank() + 1 == session.size()) std::this_thread::sleep_for(2 * kLate);
  session.barrier();
  const auto waited = std::chrono::steady_clock::now() - start;
  BOOST_TEST((waited >= kLate));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler::mpi
