// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/chunk.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <numeric>
#include <vector>

namespace tessera::scheduler {
namespace {

/// The chunks that go out one after the other until nothing is left.
template <class Chunk>
std::vector<std::uint32_t> sequence(std::uint32_t tasks, const Chunk& next) {
  std::vector<std::uint32_t> chunks;
  for (std::uint32_t remaining = tasks; remaining > 0; remaining -= chunks.back()) {
    chunks.push_back(std::min(next(remaining), remaining));
    BOOST_REQUIRE(chunks.back() > 0U);
  }
  return chunks;
}

std::vector<std::uint32_t> factoring(std::uint32_t tasks, std::uint32_t ranks) {
  return sequence(tasks, [&](std::uint32_t remaining) { return factoring_chunk(tasks, remaining, ranks); });
}

std::vector<std::uint32_t> trapezoid(std::uint32_t tasks, std::uint32_t ranks) {
  return sequence(tasks, [&](std::uint32_t remaining) { return trapezoid_chunk(tasks, remaining, ranks); });
}

using Chunks = std::vector<std::uint32_t>;
const auto each = boost::test_tools::per_element();

}  // namespace

BOOST_AUTO_TEST_SUITE(chunk)

BOOST_AUTO_TEST_CASE(guided_chunks_are_the_published_ones) {
  // Polychronopoulos and Kuck's example: 100 iterations on 5 processors.
  BOOST_TEST(sequence(100, [](std::uint32_t remaining) { return guided_chunk(remaining, 5); }) ==
                 (Chunks{20, 16, 13, 11, 8, 7, 5, 4, 4, 3, 2, 2, 1, 1, 1, 1, 1}),
             each);
}

BOOST_AUTO_TEST_CASE(factoring_halves_what_remains_in_batches_of_equal_chunks) {
  // By hand from R' = R - P F, F = ceil(R / 2P): 1000, 500, 248, 124, 60, 28, 12 and 4 remain on 4 processors.
  BOOST_TEST(factoring(1000, 4) == (Chunks{125, 125, 125, 125, 63, 63, 63, 63, 31, 31, 31, 31, 16, 16, 16, 16,
                                           8,   8,   8,   8,   4,  4,  4,  4,  2,  2,  2,  2,  1,  1,  1,  1}),
             each);
  // 100, 48, 24, 12, 4.
  BOOST_TEST(factoring(100, 4) == (Chunks{13, 13, 13, 13, 6, 6, 6, 6, 3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1}), each);
}

BOOST_AUTO_TEST_CASE(a_chunk_of_factoring_follows_from_the_batch_that_what_remains_lies_in) {
  // Batches of 100 on 4 begin with 100, 48, 24 remaining, whoever took single tasks in between.
  for (const std::uint32_t remaining : {100U, 99U, 49U}) BOOST_TEST(factoring_chunk(100, remaining, 4) == 13U);
  for (const std::uint32_t remaining : {48U, 25U}) BOOST_TEST(factoring_chunk(100, remaining, 4) == 6U);
  BOOST_TEST(factoring_chunk(100, 24, 4) == 3U);
}

BOOST_AUTO_TEST_CASE(trapezoid_falls_in_equal_steps_from_a_half_share_to_one) {
  // f = 1000 / 8 = 125, 2000 / 126 -> 16 chunks, a step of 124 / 15 = 8.27: 125, 116.7, 108.5, 100.2, 91.9, 83.7, ...
  BOOST_TEST(trapezoid(1000, 4) == (Chunks{125, 117, 108, 100, 92, 84, 75, 67, 59, 51, 42, 34, 26, 18, 2}), each);
}

BOOST_AUTO_TEST_CASE(trapezoid_falls_where_whole_steps_would_not) {
  // f = 100 / 8 -> 13, 200 / 14 -> 15 chunks, a step of 12 / 14 = 0.86.
  BOOST_TEST(trapezoid(100, 4) == (Chunks{13, 12, 11, 10, 10, 9, 8, 7, 6, 5, 5, 4}), each);
}

BOOST_AUTO_TEST_CASE(chunks_of_seconds_are_those_of_tasks_without_the_rounding) {
  BOOST_TEST(guided_chunk_s(10, 4) == 2.5);
  for (const double remaining_s : {8.0, 7.0, 4.5}) BOOST_TEST(factoring_chunk_s(8, remaining_s, 2) == 2.0);
  for (const double remaining_s : {4.0, 2.5}) BOOST_TEST(factoring_chunk_s(8, remaining_s, 2) == 1.0);
  BOOST_TEST(factoring_chunk_s(8, 2, 2) == 0.5);
  // f = 16 / 4 = 4, steps of 4 / 8: 4, 3.5, 3, 2.5, ...
  double remaining_s = 16;
  for (const double chunk_s : {4.0, 3.5, 3.0, 2.5, 2.0, 1.5}) {
    BOOST_TEST(trapezoid_chunk_s(16, remaining_s, 2) == chunk_s, boost::test_tools::tolerance(1e-12));
    remaining_s -= chunk_s;
  }
}

BOOST_AUTO_TEST_CASE(every_sequence_ends_and_never_grows) {
  for (const std::uint32_t ranks : {1U, 2U, 3U, 7U, 64U, 4096U}) {
    for (const std::uint32_t tasks : {1U, 2U, 3U, 10U, 999U, 100000U}) {
      for (const Chunks& chunks : {factoring(tasks, ranks), trapezoid(tasks, ranks)}) {
        BOOST_TEST(std::accumulate(chunks.begin(), chunks.end(), 0U) == tasks);
        BOOST_TEST(std::is_sorted(chunks.rbegin(), chunks.rend()));
        BOOST_TEST(chunks.back() <= std::max(1U, tasks / (2 * ranks)));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_is_no_chunk_and_no_endless_search) {
  BOOST_TEST(factoring_chunk(0, 0, 4) == 0U);
  BOOST_TEST(factoring_chunk(100, 0, 4) > 0U);
  BOOST_TEST(factoring_chunk_s(8, 0, 2) == 0.0);
  BOOST_TEST(factoring_chunk_s(8, 9, 2) == 2.0);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
