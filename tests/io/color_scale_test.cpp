// SPDX-License-Identifier: BSD-3-Clause
#include "io/color_scale.h"

#include <boost/test/unit_test.hpp>
#include <limits>

#include "io/oklab.h"

namespace tessera::io {

BOOST_AUTO_TEST_SUITE(ColorScale)

BOOST_AUTO_TEST_CASE(equal_steps_look_equally_large_and_get_lighter) {
  constexpr int kSteps = 16;
  const double whole = [] {
    double sum = 0;
    for (int i = 0; i != 400; ++i) {
      sum += distance_between(oklab_of(scale_color(i / 400.0)), oklab_of(scale_color((i + 1) / 400.0)));
    }
    return sum;
  }();
  BOOST_TEST(whole > 0.8);
  for (int i = 0; i != kSteps; ++i) {
    const Oklab from = oklab_of(scale_color(static_cast<double>(i) / kSteps));
    const Oklab to = oklab_of(scale_color(static_cast<double>(i + 1) / kSteps));
    // A step around a corner of the path is a little shorter, and channels are rounded
    BOOST_TEST(distance_between(from, to) > 0.8 * whole / kSteps);
    BOOST_TEST(distance_between(from, to) < 1.2 * whole / kSteps);
    BOOST_TEST(to.lightness > from.lightness + 0.03);
  }
}

BOOST_AUTO_TEST_CASE(the_ends_are_those_of_the_path_and_what_is_beyond_counts_as_them) {
  BOOST_CHECK_SMALL(oklab_of(scale_color(0)).lightness - 0.22, 0.01);
  BOOST_CHECK_SMALL(oklab_of(scale_color(1)).lightness - 0.95, 0.01);
  BOOST_TEST((scale_color(-3) == scale_color(0)));
  BOOST_TEST((scale_color(7) == scale_color(1)));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
