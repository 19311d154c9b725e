// SPDX-License-Identifier: BSD-3-Clause
#include "io/checksum.h"

#include <array>
#include <boost/test/unit_test.hpp>
#include <string_view>

namespace tessera::io {
namespace {

std::uint64_t checksum_of_text(std::string_view text, std::uint64_t seed = 0) {
  return checksum_of(std::as_bytes(std::span(text)), seed);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(ChecksumTest)

// Printed by Debian's xxhsum 0.8.1: printf '%s' TEXT | xxhsum -H3. Files outlive the library that wrote them.
BOOST_AUTO_TEST_CASE(it_is_the_published_function) {
  BOOST_TEST(checksum_of_text("") == 0x2d06800538d394c2u);
  BOOST_TEST(checksum_of_text("tessera") == 0xbf456a4d41446d60u);
}

BOOST_AUTO_TEST_CASE(pieces_are_chained_by_the_seed) {
  const std::uint64_t first = checksum_of_text("one");
  BOOST_TEST(checksum_of_text("two", first) != checksum_of_text("two"));
  BOOST_TEST(checksum_of_text("two", first) != checksum_of_text("two", first + 1));
}

BOOST_AUTO_TEST_CASE(any_bit_changes_it) {
  std::array<std::byte, 300> bytes{};
  const std::uint64_t before = checksum_of(bytes);
  for (std::size_t bit = 0; bit != 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= std::byte{1} << bit % 8;
    BOOST_TEST(checksum_of(bytes) != before);
    bytes[bit / 8] ^= std::byte{1} << bit % 8;
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
