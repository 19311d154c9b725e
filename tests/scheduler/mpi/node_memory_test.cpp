// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/node_memory.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <optional>
#include <thread>

#include "scheduler/mpi/session_for_tests.h"

namespace tessera::scheduler::mpi {
namespace {

constexpr std::size_t kBytes = 3'000'001;

std::byte pattern(std::size_t i) {
  return static_cast<std::byte>(i * i % 251);
}

void fill(NodeMemory& memory) {
  for (std::size_t i = 0; i != memory.bytes().size(); ++i) memory.bytes()[i] = pattern(i);
}

bool is_filled(const NodeMemory& memory) {
  const auto bytes = memory.bytes();
  for (std::size_t i = 0; i != bytes.size(); ++i) {
    if (bytes[i] != pattern(i)) return false;
  }
  return bytes.size() == kBytes;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(node_memory)

BOOST_AUTO_TEST_CASE(all_ranks_read_what_the_first_wrote) {
  Session& session = session_for_tests();
  for (const Sharing sharing : {Sharing::if_possible, Sharing::never}) {
    // Only the first rank says the size
    NodeMemory memory(session, session.is_first_on_node() ? kBytes : 7, sharing);
    if (session.is_first_on_node()) fill(memory);
    memory.publish(session);
    BOOST_TEST(is_filled(memory));
    if (sharing == Sharing::never) BOOST_TEST(!memory.is_shared());
  }
}

BOOST_AUTO_TEST_CASE(there_is_one_copy_where_memory_is_shared) {
  Session& session = session_for_tests();
  NodeMemory memory(session, kBytes);
  memory.publish(session);
  if (!memory.is_shared()) return;
  if (session.is_first_on_node()) fill(memory);
  session.barrier();
  BOOST_TEST(is_filled(memory));
  session.barrier();
}

BOOST_AUTO_TEST_CASE(memory_stays_though_the_first_rank_gives_it_up) {
  Session& session = session_for_tests();
  std::optional<NodeMemory> memory(std::in_place, session, kBytes);
  if (session.is_first_on_node()) fill(*memory);
  memory->publish(session);
  if (session.is_first_on_node()) memory.reset();
  session.barrier();
  BOOST_TEST((!memory || is_filled(*memory)));
}

BOOST_AUTO_TEST_CASE(no_bytes_are_fine) {
  NodeMemory memory(session_for_tests(), 0);
  memory.publish(session_for_tests());
  BOOST_TEST(memory.bytes().empty());
}

BOOST_AUTO_TEST_CASE(threads_are_no_more_than_ranks_or_cores) {
  const Session& session = session_for_tests();
  const unsigned cores = std::thread::hardware_concurrency();
  const NodeCores all(session);
  BOOST_TEST(all.threads() >= 1U);
  BOOST_TEST(all.threads() <= session.ranks_on_node());
  if (cores > 1) BOOST_TEST(all.threads() <= cores);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler::mpi
