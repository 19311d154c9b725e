// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/checksum.h"

#include <boost/test/unit_test.hpp>
#include <set>
#include <vector>

#include "scheduler/bytes.h"

namespace tessera::scheduler {
namespace {

// Sizes around the lengths at which the function changes its way: 16, 128, 240 and its blocks of 1024 bytes.
constexpr std::size_t kSizes[] = {1, 3, 4, 8, 9, 16, 17, 24, 128, 129, 240, 241, 1024, 1025, 3100};

Bytes pattern(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 31 + i / 251);
  return bytes;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(checksums)

BOOST_AUTO_TEST_CASE(nothing_has_the_published_value) {
  // XXH3 of no bytes, as in the function's own test vectors. Another value would be another protocol.
  BOOST_TEST(checksum({}) == 0x2d06800538d394c2U);
}

BOOST_AUTO_TEST_CASE(equal_bytes_have_equal_checksums_wherever_they_lie) {
  for (const std::size_t size : kSizes) {
    const Bytes bytes = pattern(size);
    Bytes moved(1);
    moved.insert(moved.end(), bytes.begin(), bytes.end());
    BOOST_TEST(checksum(bytes) == checksum(std::span(moved).subspan(1)));
  }
}

BOOST_AUTO_TEST_CASE(each_flipped_bit_changes_it) {
  for (const std::size_t size : kSizes) {
    Bytes bytes = pattern(size);
    const std::uint64_t whole = checksum(bytes);
    for (std::size_t bit = 0; bit < 8 * size; ++bit) {
      const std::byte mask{static_cast<unsigned char>(1U << (bit % 8))};
      bytes[bit / 8] ^= mask;
      BOOST_REQUIRE_MESSAGE(checksum(bytes) != whole, "bit " << bit << " of " << size << " bytes");
      bytes[bit / 8] ^= mask;
    }
  }
}

BOOST_AUTO_TEST_CASE(bytes_that_are_missing_or_swapped_change_it) {
  for (const std::size_t size : kSizes) {
    const Bytes bytes = pattern(size);
    BOOST_TEST(checksum(std::span(bytes).first(size - 1)) != checksum(bytes));
    if (size < 2) continue;
    Bytes swapped = bytes;
    std::swap(swapped.front(), swapped[size / 2]);
    if (swapped != bytes) BOOST_TEST(checksum(swapped) != checksum(bytes));
  }
  // Zeros are told apart by their number
  std::set<std::uint64_t> sums;
  for (std::size_t size = 0; size < 300; ++size) sums.insert(checksum(Bytes(size)));
  BOOST_TEST(sums.size() == 300U);
}

BOOST_AUTO_TEST_CASE(a_seed_makes_a_difference_whatever_the_bytes) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{4}, std::size_t{100}, std::size_t{2000}}) {
    std::set<std::uint64_t> sums;
    for (std::uint64_t seed = 0; seed < 100; ++seed) sums.insert(checksum(pattern(size), seed));
    BOOST_TEST(sums.size() == 100U);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
