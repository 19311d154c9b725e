// SPDX-License-Identifier: BSD-3-Clause
// Every exact decision against rational arithmetic, on input where rounding decides nothing.
#include "render/decide.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/bounded.h"
#include "render/certified.h"
#include "render/dyadic.h"
#include "render/random.h"
#include "render/rational.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

/// x moved by up to three units in its last place.
double nudged(Random& random, double x) {
  for (std::uint32_t i = random.below(4); i > 0; --i) x = std::nextafter(x, random.flip() ? 1e300 : -1e300);
  return x;
}
Vec3 nudged(Random& random, const Vec3& v) {
  return {nudged(random, v.x), nudged(random, v.y), nudged(random, v.z)};
}

/// Counts what differs from the oracle, and how often each sign came up: a test of one sign alone tests nothing.
struct Tally {
  int wrong = 0;
  int signs[3] = {};

  void add(int decided, int exact) {
    wrong += decided != exact;
    ++signs[exact + 1];
  }
  void check(int least) const {
    BOOST_TEST_MESSAGE("-: " << signs[0] << ", 0: " << signs[1] << ", +: " << signs[2]);
    BOOST_TEST(wrong == 0);
    BOOST_TEST((signs[0] >= least && signs[2] >= least));
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(decide)

// r^2 d.d - |f x d|^2 within a few ulps of tangency, near and far.
BOOST_AUTO_TEST_CASE(line_meets_sphere_is_right_at_tangency) {
  Random random(31);
  Tally tally;
  for (int i = 0; i != 20000; ++i) {
    const double radius = nudged(random, random.over_decades(1e-3, 1));
    const Vec3 direction = random.direction();
    const Vec3 side = random.perpendicular_to(direction);
    const Vec3 center = random.in_box(1);
    const Vec3 origin = nudged(random, center + radius * side - radius * random.over_decades(1, 1e9) * direction);
    tally.add(line_meets_sphere(origin, direction, center, radius),
              sgn(rational_discriminant(origin, direction, center, radius)));
  }
  tally.check(2000);
}

// Integer triangles: exactly tangent, which twice the precision cannot tell from nearly so.
BOOST_AUTO_TEST_CASE(line_meets_sphere_knows_exact_tangents) {
  Random random(32);
  int wrong = 0;
  for (int i = 0; i != 5000; ++i) {
    // (m^2 - n^2, 2mn, m^2 + n^2), moved by whole numbers, seen along z.
    const double m = 2 + random.below(1000);
    const double n = 1 + random.below(static_cast<std::uint32_t>(m) - 1);
    const double a = m * m - n * n;
    const double b = 2 * m * n;
    const Vec3 center{static_cast<double>(random.below(1u << 20)), 7, -static_cast<double>(random.below(1u << 20))};
    const Vec3 origin{center.x + a, center.y + b, center.z - 1e6};
    const Vec3 direction{0, 0, random.uniform(0.1, 1)};
    wrong += line_meets_sphere(origin, direction, center, m * m + n * n) != 0;
    wrong += line_meets_sphere(origin, direction, center, std::nextafter(m * m + n * n, 0)) != -1;
    wrong += line_meets_sphere(origin, direction, center, std::nextafter(m * m + n * n, 1e300)) != 1;
  }
  BOOST_TEST(wrong == 0);
}

BOOST_AUTO_TEST_CASE(sides_of_spheres_and_planes_are_right_within_rounding) {
  Random random(33);
  Tally sphere;
  Tally plane;
  Tally product;
  for (int i = 0; i != 20000; ++i) {
    const Vec3 center = random.in_box(1);
    const double radius = random.over_decades(1e-6, 1);
    const Vec3 point = nudged(random, center + radius * random.direction());
    const RationalVec f = rational_difference(center, point);
    sphere.add(side_of_sphere(point, center, radius),
               sgn(mpq_class(rational_dot(f, f) - mpq_class(radius) * mpq_class(radius))));

    const Vec3 normal = random.direction();
    const Vec3 on_plane = nudged(random, center + radius * random.perpendicular_to(normal));
    plane.add(side_of_plane(on_plane, center, normal),
              sgn(rational_dot(rational_difference(on_plane, center), RationalVec(normal))));
    const Vec3 across = nudged(random, random.perpendicular_to(normal));
    product.add(sign_of_dot(normal, across), sgn(rational_dot(RationalVec(normal), RationalVec(across))));
  }
  sphere.check(2000);
  plane.check(2000);
  product.check(2000);
}

BOOST_AUTO_TEST_CASE(nearest_point_is_compared_with_the_end_exactly) {
  Random random(34);
  Tally tally;
  for (int i = 0; i != 20000; ++i) {
    const Vec3 origin = random.in_box(1);
    const Vec3 direction = random.direction();
    const double end = std::ldexp(1.0, static_cast<int>(random.below(9)) - 4);
    const Vec3 center =
        nudged(random, origin + end * direction + random.uniform() * random.perpendicular_to(direction));
    const RationalVec d(direction);
    const mpq_class gap = rational_dot(rational_difference(center, origin), d) - mpq_class(end) * rational_dot(d, d);
    tally.add(nearest_point_against_end(origin, direction, end, center), sgn(gap));
  }
  tally.check(2000);
}

// Products of numbers at both ends of the range: nothing may vanish unnoticed.
BOOST_AUTO_TEST_CASE(nothing_vanishes_in_an_exact_number) {
  const double least = 0x1p-1074;
  BOOST_TEST((Dyadic(least) * Dyadic(least) * Dyadic(least)).sign() == 1);
  BOOST_TEST((Dyadic(least) * Dyadic(least) - Dyadic(0.0)).sign() == 1);
  BOOST_TEST((Dyadic(1.0) + Dyadic(least) - Dyadic(1.0) - Dyadic(least)).sign() == 0);
  BOOST_TEST((Dyadic(0x1p1000) * Dyadic(-0x1p1000) + Dyadic(least)).sign() == -1);
  BOOST_TEST(sign_of_dot({least, 0, 0}, {least, 0, 0}) == 1);
  BOOST_TEST(sign_of_dot({least, 1, 0}, {-least, 0, 1}) == -1);
}

// What a certified number says of a sign holds; where it can say nothing, it does not.
BOOST_AUTO_TEST_CASE(certified_numbers_say_nothing_that_is_not_so) {
  Random random(35);
  int wrong = 0;
  int silent = 0;
  int certain = 0;
  for (int i = 0; i != 20000; ++i) {
    // x = a b + c d - (nearly the same), with a root on the way every other time.
    const double a = random.uniform(0.5, 1);
    const double b = random.over_decades(1e-160, 1e8);
    const double c = random.uniform(-1, 1) * b;
    const double sum = a * b + c;
    const Certified x = Certified(a) * b + c;
    const mpq_class exact = mpq_class(a) * mpq_class(b) + mpq_class(c);
    const auto sign = (x - Certified(nudged(random, sum))).sign();
    const auto same = (x * x - x * x).sign();
    wrong += sign && *sign != sgn(mpq_class(exact - mpq_class(sum))) && sgn(mpq_class(exact - mpq_class(sum))) == 0;
    wrong += same && *same != 0;
    silent += !sign;
    certain += sign.has_value();
    if (!(exact > 0)) continue;
    // root(y)^2 = y for y = x, to the bound; a number a little off is told apart.
    const Certified root = root_of(x);
    const auto none = (root * root - x).sign();
    wrong += none && *none != 0;
    wrong += (root * root - x * Certified(1 + 0x1p-52)).sign() != -1 && b > 1e-120;
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(certain > 10000);
  BOOST_TEST_MESSAGE(certain << " certain, " << silent << " not");
}

BOOST_AUTO_TEST_SUITE_END()
