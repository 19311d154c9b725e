// SPDX-License-Identifier: BSD-3-Clause
#include "render/sphere.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "render/random.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr double kUlpOfOne = 0x1p-52;

std::optional<Crossing> entry(const Vec3& origin, const Vec3& direction, const Vec3& center, double radius) {
  return entry_into({.origin = origin, .direction = direction}, norm_of(direction), center, radius);
}
Crossing exit(const Vec3& origin, const Vec3& direction, const Vec3& center, double radius) {
  return exit_from({.origin = origin, .direction = direction}, norm_of(direction), center, radius);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(sphere)

// y = 1 touches x^2 + y^2 = 1 at (0, 1): t = 5, N = (0, 1, 0).
BOOST_AUTO_TEST_CASE(tangent_ray_hits_with_the_exact_distance_and_normal) {
  const Vec3 along_x{1, 0, 0};
  const auto crossing = entry({-5, 1, 0}, along_x, {}, 1);
  BOOST_REQUIRE(crossing.has_value());
  BOOST_TEST(crossing->t.value == 5);
  BOOST_TEST((normal_at(*crossing, along_x) == Vec3{0, 1, 0}));
}

BOOST_AUTO_TEST_CASE(one_ulp_of_the_radius_decides_a_tangent) {
  BOOST_TEST(!entry({-5, 1, 0}, {1, 0, 0}, {}, std::nextafter(1, 0)).has_value());
  BOOST_TEST(entry({-5, 1, 0}, {1, 0, 0}, {}, std::nextafter(1, 2)).has_value());
}

// Offsets (a, b) with a^2 + b^2 = r^2: exact tangents from any distance and on any side.
BOOST_AUTO_TEST_CASE(tangents_through_pythagorean_triples_hit) {
  const double triples[][3] = {{3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {20, 21, 29}, {696, 697, 985}};
  int lost = 0;
  int kept = 0;
  for (const auto& [a, b, r] : triples) {
    for (double distance = 1; distance < 1e9; distance *= 7) {
      const Vec3 origin{-distance, a, -b};
      const auto touch = entry(origin, {1, 0, 0}, {}, r);
      lost += !touch || touch->t.value != distance;
      kept += entry(origin, {1, 0, 0}, {}, std::nextafter(r, 0)).has_value();
      lost += !entry({a, -distance, b}, {0, 0.5, 0}, {}, r).has_value();
      lost += !entry({b, a, distance}, {-0.0, 0, -3}, {}, r).has_value();
    }
  }
  BOOST_TEST(lost == 0);
  BOOST_TEST(kept == 0);
}

// 13^2 = 5^2 + 12^2: t = 100 - 12, N = (-12, 5, 0) / 13.
BOOST_AUTO_TEST_CASE(hit_of_the_5_12_13_triangle) {
  const Vec3 along_x{1, 0, 0};
  const auto crossing = entry({-100, 5, 0}, along_x, {}, 13);
  BOOST_REQUIRE(crossing.has_value());
  BOOST_TEST(crossing->t.value == 88);
  const Vec3 n = normal_at(*crossing, along_x);
  BOOST_TEST(std::abs(n.x + 12.0 / 13) <= kUlpOfOne);
  BOOST_TEST(std::abs(n.y - 5.0 / 13) <= kUlpOfOne / 2);
  BOOST_TEST(n.z == 0);
}

// From (3, 0, 0) in a sphere of radius 5: 2 ahead, 8 behind, 4 across.
BOOST_AUTO_TEST_CASE(ray_starting_inside_hits_the_far_side) {
  BOOST_TEST(exit({3, 0, 0}, {1, 0, 0}, {}, 5).t.value == 2);
  BOOST_TEST(exit({3, 0, 0}, {-1, 0, 0}, {}, 5).t.value == 8);
  BOOST_TEST(exit({3, 0, 0}, {0, 2, 0}, {}, 5).t.value == 2);
  const Vec3 n = normal_at(exit({3, 0, 0}, {0, 1, 0}, {}, 5), {0, 1, 0});
  BOOST_TEST(std::abs(n.x - 0.6) <= kUlpOfOne);
  BOOST_TEST(std::abs(n.y - 0.8) <= kUlpOfOne);
}

BOOST_AUTO_TEST_CASE(sphere_behind_or_beside_the_origin_is_missed) {
  BOOST_TEST(!entry({5, 0, 0}, {1, 0, 0}, {}, 1).has_value());
  BOOST_TEST(!entry({5, 0.5, 0}, {1, 0, 0}, {}, 1).has_value());
  BOOST_TEST(!entry({-5, 1.5, 0}, {1, 0, 0}, {}, 1).has_value());
}

// f.d = 0 from outside: the line comes no nearer.
BOOST_AUTO_TEST_CASE(sphere_exactly_beside_the_origin_is_missed) {
  BOOST_TEST(!entry({0, 1, 0}, {1, 0, 0}, {}, 1).has_value());
  BOOST_TEST(!entry({0, 2, 0}, {1, 0, 0}, {}, 1).has_value());
}

// An origin on the surface, by rounding a hair inside: t is never negative.
BOOST_AUTO_TEST_CASE(entry_from_a_hair_inside_is_at_once) {
  const auto crossing = entry({std::nextafter(-1, 0), 0, 0}, {1, 0, 0}, {}, 1);
  BOOST_REQUIRE(crossing.has_value());
  BOOST_TEST(crossing->t.value == 0);
}

// A line that rounding has put outside has no root: the exit is its closest point, t = 0 here.
BOOST_AUTO_TEST_CASE(exit_from_a_hair_outside_is_finite) {
  BOOST_TEST(exit({0, 1, 0}, {1, 0, 0}, {}, std::nextafter(1, 0)).t.value <= 1e-7);
  BOOST_TEST(exit({1, 0, 0}, {1, 0, 0}, {}, std::nextafter(1, 0)).t.value == 0);
}

// t scales by 2^-k and the normal keeps its bits when d scales by 2^k.
BOOST_AUTO_TEST_CASE(length_of_the_direction_does_not_matter) {
  Random random(11);
  int changed = 0;
  for (int i = 0; i != 2000; ++i) {
    const Vec3 center = random.in_box(1);
    const Vec3 origin = center + 5.0 * random.direction();
    const Vec3 direction = center + 0.9 * random.direction() - origin;
    const double scale = std::ldexp(1.0, i % 101 - 50);
    const auto a = entry(origin, direction, center, 1);
    const auto b = entry(origin, scale * direction, center, 1);
    BOOST_REQUIRE((a && b));
    changed += a->t.value != scale * b->t.value || normal_at(*a, direction) != normal_at(*b, scale * direction);
  }
  BOOST_TEST(changed == 0);
}

// N.d = -4/5 on a sphere of radius 5: the chord is 2 5 4/5 = 8.
BOOST_AUTO_TEST_CASE(own_chord_is_twice_the_radius_times_the_cosine) {
  const Ray ray{.origin = {5, 0, 0}, .direction = {-0.8, 0.6, 0}, .from = surface_id(0), .from_normal = {1, 0, 0}};
  BOOST_TEST(std::abs(own_chord(ray, norm_of(ray.direction), 5).value - 8) <= 8 * kUlpOfOne);
}

// |C - P|^2 - r^2 is exactly 0 on integer triangles, and its sign follows one ulp, and one part in 2^100.
BOOST_AUTO_TEST_CASE(inside_and_outside_are_told_apart_exactly) {
  BOOST_TEST(side_of({3, 4, 0}, {}, 5) == 0);
  BOOST_TEST(side_of({1e6 + 2, 3, -1e6 + 6}, {1e6, 0, -1e6}, 7) == 0);
  BOOST_TEST(side_of({std::nextafter(3, 0), 4, 0}, {}, 5) == -1);
  BOOST_TEST(side_of({std::nextafter(3, 4), 4, 0}, {}, 5) == 1);
  BOOST_TEST(side_of({3, 4, 0x1p-60}, {}, 5) == 1);
}

BOOST_AUTO_TEST_SUITE_END()
