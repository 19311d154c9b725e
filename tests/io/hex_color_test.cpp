// SPDX-License-Identifier: BSD-3-Clause
#include "io/hex_color.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace tessera::io {

BOOST_AUTO_TEST_SUITE(HexColor)

BOOST_AUTO_TEST_CASE(digits_are_decoded_by_the_piecewise_srgb_curve) {
  const auto color = parse_hex_color("#0a80fF");
  BOOST_TEST_REQUIRE(color.has_value());
  BOOST_TEST(std::abs(color->r - 10 / 255.0 / 12.92) < 1e-16);  // below 0.04045 the curve is a line
  BOOST_TEST(std::abs(color->g - std::pow((128 / 255.0 + 0.055) / 1.055, 2.4)) < 1e-15);
  BOOST_TEST(color->b == 1);
}

BOOST_AUTO_TEST_CASE(black_and_white_are_exact) {
  BOOST_TEST((parse_hex_color("#000000").value() == render::Rgb{0, 0, 0}));
  BOOST_TEST((parse_hex_color("#FFFFFF").value() == render::Rgb{1, 1, 1}));
}

BOOST_AUTO_TEST_CASE(other_texts_are_no_colors) {
  for (const char* text : {"", "#", "red", "#fff", "ffffff", "0xffffff", "#fffff", "#fffffff", "#gggggg", "#-12345",
                           "#+12345", "# 12345", "#12345 "}) {
    BOOST_TEST(!parse_hex_color(text), text);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
