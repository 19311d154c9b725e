// SPDX-License-Identifier: BSD-3-Clause
#include "io/oklab.h"

#include <boost/test/unit_test.hpp>

namespace tessera::io {

BOOST_AUTO_TEST_SUITE(OklabTest)

BOOST_AUTO_TEST_CASE(white_black_and_red_are_where_the_paper_puts_them) {
  const Oklab white = oklab_of({255, 255, 255});
  BOOST_CHECK_SMALL(white.lightness - 1, 1e-6);
  BOOST_CHECK_SMALL(white.a, 1e-6);
  BOOST_CHECK_SMALL(white.b, 1e-6);
  BOOST_TEST(oklab_of({0, 0, 0}).lightness == 0.0);
  const Oklab red = oklab_of({255, 0, 0});
  BOOST_CHECK_SMALL(red.lightness - 0.627955, 1e-5);
  BOOST_CHECK_SMALL(red.a - 0.224863, 1e-5);
  BOOST_CHECK_SMALL(red.b - 0.125846, 1e-5);
}

BOOST_AUTO_TEST_CASE(every_pixel_comes_back) {
  for (int red = 0; red <= 255; red += 15) {
    for (int green = 0; green <= 255; green += 15) {
      for (int blue = 0; blue <= 255; blue += 15) {
        const Rgb8 color{static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
                         static_cast<std::uint8_t>(blue)};
        BOOST_TEST((rgb8_of(oklab_of(color)) == color));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
