// SPDX-License-Identifier: BSD-3-Clause
#include "render/plane.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/quad_oracle.h"
#include "render/random.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr MaterialIndex kEven{3};
constexpr MaterialIndex kOdd{7};

Plane board(const Vec3& point, const Vec3& normal, double size) {
  return {point, normal, kEven, Checker{kOdd, size}};
}

MaterialIndex expected(double u, double v, double size) {
  return std::fmod(std::floor(u / size) + std::floor(v / size), 2) == 0 ? kEven : kOdd;
}

MaterialIndex material_at(const Plane& plane, const Vec3& point) {
  return material_of(plane, cell_at(plane, point));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(plane)

BOOST_AUTO_TEST_CASE(plane_without_checker_has_one_material) {
  const Plane plane{{0, 0, 0}, {0, 0, 1}, kEven, std::nullopt};
  BOOST_TEST((material_at(plane, {0.5, -7.5, 0}) == kEven));
}

// N = z: |N_x| = 0 is the first smallest, u = x cross z = -y, v = z cross -y = x. Cells about the origin:
BOOST_AUTO_TEST_CASE(cells_of_a_floor_alternate_across_zero) {
  const Plane floor = board({0, 0, 0}, {0, 0, 1}, 1);
  BOOST_TEST((material_at(floor, {0.5, -0.5, 0}) == kEven), "cell 0 + 0");
  BOOST_TEST((material_at(floor, {1.5, -0.5, 0}) == kOdd), "cell 0 + 1");
  BOOST_TEST((material_at(floor, {0.5, 0.5, 0}) == kOdd), "cell -1 + 0");
  BOOST_TEST((material_at(floor, {-0.5, 0.5, 0}) == kEven), "cell -1 - 1");
  BOOST_TEST((material_at(floor, {-0.5, -0.5, 0}) == kOdd), "cell 0 - 1");
  BOOST_TEST((material_at(floor, {-100.5, -0.5, 0}) == kOdd), "cell 0 - 101");
}

BOOST_AUTO_TEST_CASE(board_starts_at_the_point_of_the_plane_and_cells_have_the_given_size) {
  const Plane floor = board({10, 20, -3}, {0, 0, 1}, 0.25);
  BOOST_TEST((material_at(floor, {10.125, 19.875, -3}) == kEven));
  BOOST_TEST((material_at(floor, {10.375, 19.875, -3}) == kOdd));
  BOOST_TEST((material_at(floor, {10.375, 19.625, -3}) == kEven));
  BOOST_TEST((material_at(floor, {9.875, 19.875, -3}) == kOdd));
}

// N = (0, 3, 4) / 5: u = x cross N = (0, -4, 3) / 5, v = N cross u = (1, 0, 0).
BOOST_AUTO_TEST_CASE(cells_of_a_tilted_plane_follow_its_own_axes) {
  const Plane tilted = board({1, 2, 3}, {0, 3, 4}, 2);
  const Vec3 u{0, -0.8, 0.6};
  const Vec3 v{1, 0, 0};
  for (double a = -9.5; a < 10; ++a) {
    for (double b = -9.5; b < 10; ++b) {
      const Vec3 point = tilted.point + a * u + b * v;
      BOOST_REQUIRE((material_at(tilted, point) == expected(a, b, 2)));
    }
  }
}

// Any normal: e_i for the smallest |N_i|, u = e_i x N / |e_i x N|, v = N x u; the length of N plays no part.
BOOST_AUTO_TEST_CASE(cells_of_any_plane_follow_the_formula) {
  Random random(81);
  int wrong = 0;
  for (int i = 0; i != 5000; ++i) {
    const Vec3 n = random.direction();
    const double ax = std::abs(n.x);
    const double ay = std::abs(n.y);
    const double az = std::abs(n.z);
    const Vec3 e = ax <= ay && ax <= az ? Vec3{1, 0, 0} : ay <= az ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    const Vec3 u = normalized(cross(e, n));
    const Vec3 v = cross(n, u);
    const Plane plane = board(random.in_box(10), random.over_decades(0.01, 100) * n, random.over_decades(0.1, 10));
    const double a = random.uniform(-50, 50);
    const double b = random.uniform(-50, 50);
    wrong += material_at(plane, plane.point + a * u + b * v) != expected(a, b, plane.checker->size);
  }
  BOOST_TEST(wrong == 0);
}

// |N_x| = |N_y| = |N_z|: the first axis counts. u = (0, -1, 1) / sqrt 2.
BOOST_AUTO_TEST_CASE(first_of_equal_axes_gives_the_board) {
  const Plane plane = board({0, 0, 0}, {1, 1, 1}, 1);
  const Vec3 u{0, -std::sqrt(0.5), std::sqrt(0.5)};
  const Vec3 v = cross(normalized({1, 1, 1}), u);
  BOOST_TEST((material_at(plane, 0.5 * u + 0.5 * v) == kEven));
  BOOST_TEST((material_at(plane, 1.5 * u + 0.5 * v) == kOdd));
  BOOST_TEST((material_at(plane, 0.5 * u - 0.5 * v) == kOdd));
}

// |N_y| is the smaller one by its last bit, which normalising may round away.
BOOST_AUTO_TEST_CASE(axis_is_chosen_by_the_normal_as_given) {
  Random random(82);
  int made_equal = 0;
  for (int i = 0; i != 1000; ++i) {
    const double x = random.uniform(0.1, 0.9);
    const Vec3 n{x, std::nextafter(x, 0), 1};
    made_equal += normalized(n).x == normalized(n).y;
    BOOST_REQUIRE((CheckerAxes(board({0, 0, 0}, n, 1)).u == normalized(cross({0, 1, 0}, normalized(n)))));
  }
  BOOST_TEST(made_equal > 0);
}

// Cells past 2^63: no integer may overflow.
BOOST_AUTO_TEST_CASE(points_far_out_have_some_material) {
  const Plane floor = board({0, 0, 0}, {0, 0, 1}, 1e-3);
  for (const double far : {1e18, -1e18, 1e100, -1e300}) {
    const MaterialIndex material = material_at(floor, {far, far / 3, 0});
    BOOST_TEST((material == kEven || material == kOdd));
  }
}

// t = ((P - O).n) / (d.n) in quad precision, for origins down to a hair from the plane and rays that graze it.
BOOST_AUTO_TEST_CASE(first_look_at_a_plane_is_sure_only_of_what_is_so) {
  Random random(82);
  int contradictions = 0;
  int sure = 0;
  const int count = 100000;
  for (int i = 0; i != count; ++i) {
    const Plane plane =
        board(random.over_decades(1e-3, 1e3) * random.in_box(1), random.over_decades(0.1, 10) * random.direction(), 1);
    const Vec3 along = random.perpendicular_to(plane.normal);
    const double height = (random.flip() ? 1 : -1) * random.over_decades(1e-18, 1e3);
    const double slope = (random.flip() ? 1 : -1) * random.over_decades(1e-18, 1);
    const Ray ray{.origin = plane.point + random.over_decades(1e-3, 1e3) * along + height * plane.normal,
                  .direction = random.over_decades(0.01, 100) * (along + slope * plane.normal)};
    const int side = side_of(ray.origin, plane);
    if (side == 0) continue;
    const PlaneLookRay of_ray{length(ray.direction), sum_of_sizes(ray.origin)};
    const PlaneLookBounds of_plane{sum_of_sizes(plane.normal), sum_of_sizes(plane.point)};
    const PlaneLook look(ray, of_ray, plane, of_plane, side);
    const int heading = side * heading_of(ray.direction, plane);
    contradictions += look.surely_recedes() && heading < 0;
    contradictions += look.surely_approaches() && heading >= 0;
    sure += look.surely_recedes() + look.surely_approaches();
    if (!look.surely_approaches()) continue;
    const Quad exact = quad_dot(QuadVec(plane.point) - QuadVec(ray.origin), plane.normal) /
                       quad_dot(QuadVec(ray.direction), plane.normal);
    const Bounded t = look.distance();
    contradictions += error_of(t.value, exact) > t.error;
    contradictions += sure_distance_to(plane, ray, side) != distance_to(plane, ray, side)->value;
  }
  BOOST_TEST(contradictions == 0);
  BOOST_TEST(sure > count / 2);
}

BOOST_AUTO_TEST_SUITE_END()
