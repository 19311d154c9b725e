// SPDX-License-Identifier: BSD-3-Clause
// sphere.h against the same formulas in quad precision, over decades of the distance.
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/quad_oracle.h"
#include "render/random.h"
#include "render/sphere.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr int kRays = 4000;
constexpr double u = kUnitRoundoff;

/// A ray from `distance` radii away whose line passes the centre at `passing` radii.
struct Approach {
  Vec3 center;
  double radius;
  Ray ray;

  Approach(Random& random, double distance, double passing) {
    radius = random.over_decades(1e-3, 1e3);
    center = radius * random.in_box(2);
    const Vec3 away = random.direction();
    ray.origin = center + distance * radius * away;
    const Vec3 aim = center + passing * radius * random.perpendicular_to(away);
    ray.direction = random.over_decades(0.1, 10) / (distance * radius) * (aim - ray.origin);
  }
};

/// Largest errors seen: t in units of u t, the normal's length in absolute terms.
struct Errors {
  double t = 0;
  double normal = 0;
  int out_of_bound = 0;  ///< t further off than its own bound says

  void include(const Approach& a, const Crossing& crossing, Quad exact_t) {
    const QuadVec at = QuadVec(a.ray.origin) + exact_t * QuadVec(a.ray.direction) - QuadVec(a.center);
    const double error = error_of(crossing.t.value, exact_t);
    t = std::max(t, error / (u * crossing.t.value));
    out_of_bound += error > crossing.t.error;
    normal = std::max(normal, error_of(normal_at(crossing, a.ray.direction), (1 / Quad(a.radius)) * at));
  }
};

QuadLine line_of(const Approach& a) {
  return {a.ray.origin, a.ray.direction, a.center, a.radius};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(sphere_accuracy)

// |t - exact| <= 8 u t and |N - exact| <= 1e-15 for l < 0.9 r, no matter how far the sphere is.
BOOST_AUTO_TEST_CASE(entry_and_its_normal_keep_their_digits_over_distance) {
  Random random(21);
  for (const double distance : {1.01, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e12}) {
    Errors errors;
    for (int i = 0; i != kRays; ++i) {
      const Approach a(random, distance, random.uniform(0, 0.88));
      const auto crossing = entry_into(a.ray, norm_of(a.ray.direction), a.center, a.radius);
      if (distance > 1e7 && line_of(a).discriminant < 0) continue;
      BOOST_REQUIRE(crossing.has_value());
      if (crossing->t.value > 0.01 * distance * a.radius / length(a.ray.direction))
        errors.include(a, *crossing, line_of(a).near());
    }
    BOOST_TEST_MESSAGE("entry at D/r " << distance << ": t " << errors.t << " u, normal " << errors.normal);
    BOOST_TEST(errors.t <= 8);
    BOOST_TEST(errors.normal <= 1e-15);
    BOOST_TEST(errors.out_of_bound == 0);
  }
}

// From inside, t = (b + s) / a or c / (b - s): neither cancels.
BOOST_AUTO_TEST_CASE(exit_and_its_normal_keep_their_digits) {
  Random random(22);
  Errors errors;
  for (int i = 0; i != 10 * kRays; ++i) {
    const Approach a(random, random.uniform(0.001, 0.88), 0);
    Approach turned = a;
    turned.ray.direction = random.over_decades(0.1, 10) * random.direction();
    const Crossing crossing = exit_from(turned.ray, norm_of(turned.ray.direction), a.center, a.radius);
    errors.include(turned, crossing, line_of(turned).far());
  }
  BOOST_TEST_MESSAGE("exit: t " << errors.t << " u, normal " << errors.normal);
  BOOST_TEST(errors.t <= 8);
  BOOST_TEST(errors.normal <= 1e-15);
  BOOST_TEST(errors.out_of_bound == 0);
}

// l / r = 1 - 10^-k: the half chord h is known to 20 u (r / h)^2 relative.
BOOST_AUTO_TEST_CASE(grazing_chord_is_as_long_as_the_radius_allows_to_know) {
  Random random(23);
  double worst = 0;
  int out_of_bound = 0;
  for (int k = 1; k <= 13; ++k) {
    for (int i = 0; i != kRays; ++i) {
      const Approach a(random, random.over_decades(2, 1e3), 1 - std::pow(10.0, -k));
      const DirectionNorm norm = norm_of(a.ray.direction);
      const Passage passage = passage_of(a.ray, norm, a.center, a.radius);
      const Bounded s = half_chord(passage);
      const QuadLine exact = line_of(a);
      out_of_bound += error_of(passage.discriminant.value, exact.discriminant) > passage.discriminant.error;
      if (!(exact.discriminant > 0) || !(passage.discriminant.value > 0)) continue;
      const Quad h = square_root(exact.discriminant);
      const double ratio = a.radius * norm.length / static_cast<double>(h);
      out_of_bound += error_of(s.value, h) > s.error;
      worst = std::max(worst, error_of(s.value, h) / static_cast<double>(h) / (u * ratio * ratio));
    }
  }
  BOOST_TEST_MESSAGE("grazing half chord: " << worst << " u (r/h)^2");
  BOOST_TEST(worst <= 20);
  BOOST_TEST(out_of_bound == 0);
}

// Hit or miss is right wherever quad precision can tell.
BOOST_AUTO_TEST_CASE(hit_or_miss_is_right_to_the_rim) {
  Random random(24);
  int wrong = 0;
  for (int i = 0; i != 20 * kRays; ++i) {
    const double passing = 1 + (random.flip() ? 1 : -1) * random.over_decades(u, 1);
    const Approach a(random, random.over_decades(3, 1e9), passing);
    const QuadLine exact = line_of(a);
    const bool hit = entry_into(a.ray, norm_of(a.ray.direction), a.center, a.radius).has_value();
    wrong += hit != (exact.discriminant > 0);
  }
  BOOST_TEST(wrong == 0);
}

// Whatever the first look calls sure is so in quad precision, and the second look too.
BOOST_AUTO_TEST_CASE(first_look_is_sure_only_of_what_is_so) {
  Random random(25);
  int contradictions = 0;
  int sure = 0;
  for (int i = 0; i != 50 * kRays; ++i) {
    const double passing = 1 + (random.flip() ? 1 : -1) * random.over_decades(1e-18, 1);
    Approach a(random, random.over_decades(1.0000001, 1e9), passing);
    if (i % 5 == 0) a.ray.direction = random.perpendicular_to(a.center - a.ray.origin);
    const double reach = length(a.center - a.ray.origin) + a.radius;
    const LookBounds first = look_bounds(norm_of(a.ray.direction), reach);
    const QuadLine exact = line_of(a);
    const Quad b = quad_dot(QuadVec(a.center) - QuadVec(a.ray.origin), a.ray.direction);
    const Quad nearest = b / quad_dot(a.ray.direction, a.ray.direction);
    const bool passes = exact.discriminant < 0;
    // An end of the ray about the nearest point.
    const double nudge = 1 + (random.flip() ? 1 : -1) * random.over_decades(1e-18, 1);
    const double end = nudge * static_cast<double>(nearest);
    for (const LookBounds& bounds : {first, closer_bounds(first, a.ray.origin, a.center, a.radius)}) {
      const FirstLook look(a.ray, bounds, a.center, a.radius);
      contradictions += look.surely_passes(bounds) && !passes;
      contradictions += look.surely_lies_behind(bounds) && !(b < 0);
      contradictions += look.surely_meets(bounds) && (passes || !(b > 0));
      contradictions += look.is_surely_before(end, bounds) && !(nearest < end);
      sure += look.surely_passes(bounds) + look.surely_meets(bounds) + look.is_surely_before(end, bounds);
      if (!look.surely_meets(bounds)) continue;
      const Bounded t = look.entry(bounds);
      contradictions += error_of(t.value, exact.near()) > t.error;
    }
  }
  BOOST_TEST(contradictions == 0);
  BOOST_TEST(sure > 40 * kRays);
}

// A sphere that is tiny beside the scene: its own bounds tell.
BOOST_AUTO_TEST_CASE(second_look_is_sure_of_a_small_sphere_in_a_large_scene) {
  Random random(27);
  int unsure_at_first = 0;
  int unsure = 0;
  for (int i = 0; i != kRays; ++i) {
    const Approach a(random, random.over_decades(1.1, 1e3), random.flip() ? 0.9 : 1.1);
    const double reach = 1e15 * a.radius;
    const LookBounds first = look_bounds(norm_of(a.ray.direction), reach);
    const LookBounds second = closer_bounds(first, a.ray.origin, a.center, a.radius);
    const auto tells = [&](const LookBounds& bounds) {
      const FirstLook look(a.ray, bounds, a.center, a.radius);
      return look.surely_passes(bounds) || look.surely_meets(bounds);
    };
    unsure_at_first += !tells(first);
    unsure += !tells(second);
  }
  BOOST_TEST(unsure_at_first == kRays);
  BOOST_TEST(unsure == 0);
}

// |C - P|^2 - r^2 and f.d to u of themselves plus what twice the precision loses, and never beyond their bounds.
BOOST_AUTO_TEST_CASE(powers_and_products_keep_to_their_bounds) {
  Random random(26);
  int outside = 0;
  for (int i = 0; i != 5 * kRays; ++i) {
    const Approach a(random, i % 2 == 0 ? 1.0 : random.over_decades(1e-3, 1e6), 0);
    const QuadVec f = QuadVec(a.center) - QuadVec(a.ray.origin);
    const Quad exact = quad_dot(f, f) - Quad(a.radius) * a.radius;
    const ExactDifference difference = exact_difference(a.center, a.ray.origin);
    const Bounded power = bounded_power(difference, a.radius);
    const double size = static_cast<double>(quad_dot(f, f)) + a.radius * a.radius;
    outside += error_of(power.value, exact) > power.error;
    outside += power.error > 2 * u * std::abs(power.value) + 70 * u * u * size;

    const Vec3 direction = i % 3 == 0 ? random.perpendicular_to(a.center - a.ray.origin) : random.direction();
    const Bounded product = bounded_dot(difference, direction);
    outside += error_of(product.value, quad_dot(f, direction)) > product.error;
    outside += product.error > 2 * u * std::abs(product.value) + 40 * u * u * std::sqrt(size);
  }
  BOOST_TEST(outside == 0);
}

BOOST_AUTO_TEST_SUITE_END()
