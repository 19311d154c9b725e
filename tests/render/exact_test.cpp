// SPDX-License-Identifier: BSD-3-Clause
#include "render/exact.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/quad_oracle.h"
#include "render/random.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr int kTrials = 20000;

// Of either sign, with exponents so close that sums of two fit in a quad's 113 bits.
double any(Random& random) {
  return (random.flip() ? 1 : -1) * random.over_decades(1e-8, 1e8) * random.uniform(0.5, 1);
}

Quad exact_sum(const TwoTerm& a) {
  return Quad(a.hi) + Quad(a.lo);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(exact)

// 1 + 2^-60 does not fit in one double.
BOOST_AUTO_TEST_CASE(two_sum_keeps_what_rounding_drops) {
  const TwoTerm sum = two_sum(1, 0x1p-60);
  BOOST_TEST(sum.hi == 1);
  BOOST_TEST(sum.lo == 0x1p-60);
}

// (1 + 2^-30)^2 = 1 + 2^-29 + 2^-60
BOOST_AUTO_TEST_CASE(two_prod_keeps_what_rounding_drops) {
  const TwoTerm product = two_prod(1 + 0x1p-30, 1 + 0x1p-30);
  BOOST_TEST(product.hi == 1 + 0x1p-29);
  BOOST_TEST(product.lo == 0x1p-60);
}

// hi + lo = a op b, and hi alone is the rounded result: |lo| <= u |hi|.
BOOST_AUTO_TEST_CASE(two_term_results_are_exact_and_normalised) {
  Random random(1);
  int inexact = 0;
  int overlapping = 0;
  for (int i = 0; i != kTrials; ++i) {
    const double a = any(random);
    const double b = any(random);
    const TwoTerm sum = two_sum(a, b);
    const TwoTerm diff = two_diff(a, b);
    const TwoTerm prod = two_prod(a, b);
    inexact += exact_sum(sum) != Quad(a) + b;
    inexact += exact_sum(diff) != Quad(a) - b;
    inexact += exact_sum(prod) != Quad(a) * b;
    for (const TwoTerm& r : {sum, diff, prod}) overlapping += std::abs(r.lo) > kUnitRoundoff * std::abs(r.hi);
  }
  BOOST_TEST(inexact == 0);
  BOOST_TEST(overlapping == 0);
}

// (1 + e)(1 - e) - 1 1 = -e^2 with e = 2^-30: the products alone round to 1 and 1.
BOOST_AUTO_TEST_CASE(difference_of_products_survives_cancellation) {
  BOOST_TEST(difference_of_products(1 + 0x1p-30, 1 - 0x1p-30, 1, 1) == -0x1p-60);
}

// |computed - exact| <= 1.5 ulp of the result, c d being as close to a b as doubles allow.
BOOST_AUTO_TEST_CASE(difference_of_products_is_off_by_at_most_one_and_a_half_ulp) {
  Random random(2);
  double worst = 0;
  for (int i = 0; i != kTrials; ++i) {
    const double a = any(random);
    const double b = any(random);
    const double c = any(random);
    const double d = i % 2 == 0 ? a * b / c : any(random);
    const Quad truth = Quad(a) * b - Quad(c) * d;
    const double result = difference_of_products(a, b, c, d);
    if (result == 0) {
      BOOST_TEST((truth == 0));
      continue;
    }
    const double ulp = std::ldexp(1.0, std::ilogb(result) - 52);
    worst = std::max(worst, error_of(result, truth) / ulp);
  }
  BOOST_TEST(worst <= 1.5);
  BOOST_TEST_MESSAGE("difference_of_products: worst error " << worst << " ulp");
}

// a x (2^k a) = 0 exactly, whatever the products round to.
BOOST_AUTO_TEST_CASE(exact_cross_of_parallel_vectors_is_zero) {
  Random random(3);
  int nonzero = 0;
  for (int i = 0; i != kTrials; ++i) {
    const Vec3 a{any(random), any(random), any(random)};
    nonzero += exact_cross(a, std::ldexp(1.0, i % 40 - 20) * a) != Vec3{};
  }
  BOOST_TEST(nonzero == 0);
}

// 1e16 + 1 - 1e16 = 1, which plain double loses.
BOOST_AUTO_TEST_CASE(compensated_sum_survives_cancellation) {
  CompensatedSum sum;
  sum.add_product(1e8, 1e8);
  sum.add_product(1, 1);
  sum.add_product(-1e8, 1e8);
  BOOST_TEST(sum.value() == 1);
}

// Dot2: |computed - exact| <= u |exact| + n^2 u^2 Sum |a_i b_i|
BOOST_AUTO_TEST_CASE(compensated_sum_is_as_good_as_twice_the_precision) {
  Random random(4);
  int outside = 0;
  for (int i = 0; i != kTrials; ++i) {
    CompensatedSum sum;
    Quad truth = 0;
    double size = 0;
    for (int term = 0; term != 4; ++term) {
      const double a = any(random);
      const double b = term == 3 ? static_cast<double>(-truth) / a : any(random);
      sum.add_product(a, b);
      truth += Quad(a) * b;
      size += std::abs(a * b);
    }
    const double u = kUnitRoundoff;
    outside += error_of(sum.value(), truth) > u * error_of(0, truth) + 16 * u * u * size;
  }
  BOOST_TEST(outside == 0);
}

// (hi + lo) = a - b on every axis
BOOST_AUTO_TEST_CASE(exact_difference_loses_nothing) {
  Random random(5);
  int inexact = 0;
  for (int i = 0; i != kTrials; ++i) {
    const Vec3 a{any(random), any(random), any(random)};
    const Vec3 b{any(random), any(random), any(random)};
    const ExactDifference d = exact_difference(a, b);
    for (int axis = 0; axis != 3; ++axis) inexact += Quad(d.hi[axis]) + d.lo[axis] != Quad(a[axis]) - b[axis];
  }
  BOOST_TEST(inexact == 0);
}

BOOST_AUTO_TEST_SUITE_END()
