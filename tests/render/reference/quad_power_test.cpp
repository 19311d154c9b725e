// SPDX-License-Identifier: BSD-3-Clause
#include "render/reference/quad_power.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/power.h"
#include "render/quad_oracle.h"
#include "render/random.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

double relative_error(Quad value, Quad exact) {
  return static_cast<double>(magnitude((value - exact) / exact));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(quad_power_function)

BOOST_AUTO_TEST_CASE(corners_of_the_range) {
  BOOST_TEST((quad_power(0, 0) == 1));
  BOOST_TEST((quad_power(0.5, 0) == 1));
  BOOST_TEST((quad_power(0, 0.5) == 0));
  BOOST_TEST((quad_power(1, 1e30) == 1));
  BOOST_TEST((quad_power(0.75, 1e30) == 0));
  BOOST_TEST((quad_power(0.5, 1074) == 0x1p-1074));
}

// b^y b^(n - y) = b^n, with a whole power on the right that multiplications alone give.
BOOST_AUTO_TEST_CASE(fractional_powers_multiply_to_a_whole_one) {
  Random random(61);
  double worst = 0;
  for (int i = 0; i != 20000; ++i) {
    const Quad base = i % 2 == 0 ? random.uniform() : random.over_decades(1e-300, 1);
    const double exponent = random.below(1 << 20) * 0x1p-20;
    worst = std::max(worst,
                     relative_error(quad_power(base, 3 - exponent) * quad_power(base, exponent), base * base * base));
  }
  BOOST_TEST_MESSAGE("error " << worst);
  BOOST_TEST(worst <= 0x1p-96);
}

// Roots that can be checked by squaring.
BOOST_AUTO_TEST_CASE(half_power_is_the_root) {
  Random random(62);
  double worst = 0;
  for (int i = 0; i != 20000; ++i) {
    const Quad base = random.over_decades(1e-300, 1);
    worst = std::max(worst, relative_error(quad_power(base, 0.5), square_root(base)));
  }
  BOOST_TEST(worst <= 0x1p-97);
}

// The renderer's power against this one, to its stated bound (8 + y) u.
BOOST_AUTO_TEST_CASE(agrees_with_the_power_in_double) {
  Random random(63);
  double worst = 0;
  for (int i = 0; i != 20000; ++i) {
    const double base = random.uniform(0.1, 1);
    const double exponent = random.over_decades(0.01, 200);
    const Quad exact = quad_power(base, exponent);
    worst = std::max(worst,
                     error_of(power(base, exponent), exact) / static_cast<double>(exact) / ((8 + exponent) * 0x1p-53));
  }
  BOOST_TEST_MESSAGE("error / bound " << worst);
  BOOST_TEST(worst <= 1);
}

BOOST_AUTO_TEST_SUITE_END()
