// SPDX-License-Identifier: BSD-3-Clause
#include "render/power.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/exact.h"
#include "render/random.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr double u = kUnitRoundoff;

/// In u, relative; the long double of the library is the oracle.
double error_in_u(double value, long double exact) {
  return static_cast<double>(std::abs((static_cast<long double>(value) - exact) / exact)) / u;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(power_function)

BOOST_AUTO_TEST_CASE(corners_of_the_range) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  BOOST_TEST(power(0, 0) == 1);
  BOOST_TEST(power(0.5, 0) == 1);
  BOOST_TEST(power(0, 0.5) == 0);
  BOOST_TEST(power(0, 3) == 0);
  BOOST_TEST(power(1, 1e30) == 1);
  BOOST_TEST(power(1, 0.3) == 1);
  BOOST_TEST(power(std::nextafter(1, 0), 1e30) == 0);
  BOOST_TEST(power(std::nextafter(1, 2), 1e30) == kInf);
  BOOST_TEST(power(0.5, 1074) == 0x1p-1074);
  BOOST_TEST(power(0.5, 1080) == 0);
  BOOST_TEST(power(0.75, 0.1) < 1);
}

// Whole powers of two and their roots are exact.
BOOST_AUTO_TEST_CASE(powers_of_two_are_exact) {
  for (int k = -250; k <= 250; ++k) {
    BOOST_TEST(power(std::ldexp(1.0, k), 3) == std::ldexp(1.0, 3 * k));
    BOOST_TEST(power(std::ldexp(1.0, 2 * k), 0.5) == std::ldexp(1.0, k));
    BOOST_TEST(power(std::ldexp(1.0, 4 * k), 0.25) == std::ldexp(1.0, k));
  }
}

// Relative error at most (8 + y) u, for the weights that a highlight can have and the exponents of the sRGB curve.
BOOST_AUTO_TEST_CASE(error_stays_within_its_bound) {
  Random random(51);
  double fraction = 0;
  double whole = 0;
  for (int i = 0; i != 200000; ++i) {
    const double base = i % 2 == 0 ? random.uniform() : random.over_decades(1e-300, 1e3);
    const double exponents[] = {random.uniform(), 1 / 2.4, 2.4, random.over_decades(1, 1e4),
                                random.below(100000) + 1.0};
    for (const double exponent : exponents) {
      const long double exact = std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
      if (!(exact > 1e-300L && exact < 1e300L)) continue;
      const double error = error_in_u(power(base, exponent), exact);
      BOOST_REQUIRE(error <= 8 + exponent);
      if (exponent < 1) fraction = std::max(fraction, error);
      if (exponent == std::floor(exponent)) whole = std::max(whole, error / exponent);
    }
  }
  BOOST_TEST_MESSAGE("exponent below 1: " << fraction << " u; whole exponent n: " << whole << " n u");
  BOOST_TEST(fraction <= 8);
}

// (a^2)^(y/2) = a^y: no jump where the exponent is split into its parts.
BOOST_AUTO_TEST_CASE(power_falls_as_its_exponent_grows) {
  double last = 1;
  for (double exponent = 0; exponent < 6; exponent += 0.001) {
    const double value = power(0.75, exponent);
    BOOST_REQUIRE(value <= last);
    last = value;
  }
}

BOOST_AUTO_TEST_CASE(tangent_keeps_its_digits_to_both_ends) {
  BOOST_TEST(tangent_of_degrees(0) == 0);
  double worst = 0;
  Random random(52);
  constexpr long double kRadians = std::numbers::pi_v<long double> / 180;
  for (int i = 0; i != 200000; ++i) {
    const double degrees = i % 2 == 0 ? random.uniform(0, 45) : random.over_decades(1e-12, 45);
    worst = std::max(worst, error_in_u(tangent_of_degrees(degrees), std::tan(kRadians * degrees)));
    // Near the pole by the complement, which loses nothing.
    const double rest = random.over_decades(1e-13, 45);
    const double steep = 90 - rest;
    worst = std::max(worst, error_in_u(tangent_of_degrees(steep), 1 / std::tan(kRadians * (90.0L - steep))));
  }
  BOOST_TEST_MESSAGE("tangent: " << worst << " u");
  BOOST_TEST(worst <= 8);
}

BOOST_AUTO_TEST_SUITE_END()
