// SPDX-License-Identifier: BSD-3-Clause
// The tree's float coordinates leave out only what is not hit, wherever eye, spheres and base of the coordinates are.
#include "render/tree_space.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "render/random.h"
#include "render/random_spheres.h"
#include "render/tree_check.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

/// A unit vector along an axis, the other components being zeros of either sign.
Vec3 along_an_axis(Random& random) {
  const double zero = random.flip() ? 0.0 : -0.0;
  const double one = random.flip() ? 1 : -1;
  const std::uint32_t axis = random.below(3);
  return {axis == 0 ? one : zero, axis == 1 ? one : -zero, axis == 2 ? one : zero};
}

/// From up to `farthest` extents away, into a sphere and about its rim; half of the rays along an axis, which from far
/// away is what still aims well.
void trace_from_afar(TreeCheck& check, Random& random, double extent, double farthest, int count) {
  for (int i = 0; i != count; ++i) {
    const Sphere& aim = one_of(random, check.spheres());
    const double distance = extent * random.over_decades(1, farthest);
    const Vec3 direction = i % 2 == 0 ? along_an_axis(random) : random.direction();
    const Vec3 across = random.perpendicular_to(direction);
    const double rim = aim.radius * (random.flip() ? random.uniform() : 1 - random.over_decades(1e-16, 1e-2));
    check.trace(aim.center + rim * across - distance * direction, random.over_decades(1e-28, 1e28) * direction);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tree_space)

BOOST_AUTO_TEST_CASE(spheres_of_all_sizes_are_found_from_any_distance) {
  Random random(101);
  for (const double extent : {1.0, 1e-3, 1e-30, 1e-60, 1e-130}) {
    for (const double decades : {1.0, 6.0, 12.0}) {
      TreeCheck check("extent " + std::to_string(std::log10(extent)) + ", decades " + std::to_string(decades),
                      cloud(random, {0, 0, 0}, extent, decades, 100));
      trace_from_afar(check, random, extent, 1e12, 300);
    }
  }
}

// The eye at unit distance from a scene that is a point from there: its place in the tree is not known to a float, nor
// to a double.
BOOST_AUTO_TEST_CASE(scene_of_hardly_any_extent_is_found) {
  Random random(102);
  for (const double extent : {1e-8, 1e-15, 1e-40, 1e-80, 1e-130}) {
    TreeCheck check("extent " + std::to_string(std::log10(extent)), cloud(random, {0, 0, 0}, extent, 2, 100));
    for (int i = 0; i != 300; ++i) {
      const Sphere& aim = one_of(random, check.spheres());
      const Vec3 direction = along_an_axis(random);
      const Vec3 off = random.uniform(0, 1.1) * aim.radius * random.perpendicular_to(direction);
      const auto placed = [&](double d, double c) { return d == 0 ? c : -d; };
      const Vec3 at = aim.center + off;
      check.trace({placed(direction.x, at.x), placed(direction.y, at.y), placed(direction.z, at.z)}, direction);
    }
  }
}

// There a skew ray's origin is off by up to a thousandth of the scene.
BOOST_AUTO_TEST_CASE(skew_rays_from_the_largest_distances_find_what_they_hit) {
  Random random(107);
  TreeCheck check("far", cloud(random, {0.3, -0.1, 0.2}, 1, 3, 300));
  for (int i = 0; i != 5000; ++i) {
    const Vec3 direction = random.direction();
    check.trace(one_of(random, check.spheres()).center - random.over_decades(1e10, 1e13) * direction, direction);
  }
}

// As far from the middle as a sphere can be: a ray must not begin behind them.
BOOST_AUTO_TEST_CASE(spheres_in_the_corners_of_the_scene_are_found) {
  std::vector<Sphere> spheres;
  for (int i = 0; i != 8; ++i) {
    spheres.push_back({{i % 2 * 2 - 1.0, i / 2 % 2 * 2 - 1.0, i / 4 * 2 - 1.0}, 0x1p-10, MaterialIndex{0}});
  }
  TreeCheck check("corners", spheres);
  for (const Sphere& sphere : spheres) {
    for (int k = -4; k != 41; ++k) check.trace((1 + std::ldexp(1.0, k)) * sphere.center, -sphere.center);
  }
}

// Most spheres in a cluster, where floats are fine, the others far from it; and the whole far from the origin.
BOOST_AUTO_TEST_CASE(spheres_far_from_the_base_are_found) {
  Random random(103);
  for (const double cluster : {1e-2, 1e-6, 1e-12}) {
    for (const double offset : {0.0, 1e2, 1e6}) {
      const Vec3 base = offset * Vec3{1, -1, 0.5};
      std::vector<Sphere> spheres = cloud(random, base, cluster, 2, 120);
      for (const Sphere& sphere : cloud(random, base, 1, 10, 60)) spheres.push_back(sphere);
      TreeCheck check("cluster of " + std::to_string(std::log10(cluster)) + " at " + std::to_string(offset), spheres);
      BOOST_TEST(length(check.base() - base) < 0.1 + cluster);
      trace_from_afar(check, random, 1, 1e12, 400);
      trace_from_afar(check, random, cluster, 1e3, 200);
      for (int i = 0; i != 300; ++i) {
        const Sphere& aim = one_of(random, check.spheres());
        const Vec3 eye = base + cluster * random.in_box(2);
        const double rim = aim.radius * (1 - random.over_decades(1e-12, 1e-2));
        if (eye == aim.center) continue;
        check.trace(eye, aim.center + rim * random.perpendicular_to(aim.center - eye) - eye);
      }
    }
  }
}

// Tangents in the faces of boxes, along edges through a sphere's pole, and origins in the plane of a face: all on
// numbers that do not round, so that they touch.
BOOST_AUTO_TEST_CASE(rays_in_the_faces_of_boxes_find_the_spheres_they_touch) {
  Random random(104);
  for (const double unit : {1.0, 0x1p-10, 0x1p-100}) {
    std::vector<Sphere> spheres;
    const auto whole = [&](std::uint32_t bound) { return unit * (static_cast<double>(random.below(bound)) + 1); };
    for (int i = 0; i != 100; ++i) {
      spheres.push_back({{whole(1000), -whole(1000), whole(1000)}, whole(60), MaterialIndex{0}});
    }
    TreeCheck check("unit " + std::to_string(unit), spheres);
    for (int i = 0; i != 600; ++i) {
      const Sphere& aim = one_of(random, spheres);
      const Vec3 side = along_an_axis(random);
      const Vec3 pole = aim.center + aim.radius * side;
      Vec3 direction = along_an_axis(random);
      if (dot(direction, side) != 0) continue;
      if (i % 3 == 0) direction = direction + 2 * cross(direction, side);
      check.trace(pole - whole(5000) * direction, direction);          // along the face
      check.trace(pole - unit * direction, direction);                 // from a point of the face's plane
      check.trace(aim.center + 3.0 * whole(500) * side, -0.5 * side);  // through the middle of the face
    }
  }
}

// Through corners and edges of a box, on numbers that do not round: the box is met, and not later than there.
BOOST_AUTO_TEST_CASE(rays_through_corners_and_edges_meet_their_box) {
  Random random(105);
  int tried = 0;
  int lost = 0;
  for (int i = 0; i != 40000; ++i) {
    // A corner at any distance from the base, the origin up to 2^38 steps from it
    const double unit = std::ldexp(1.0, -7 - static_cast<int>(random.below(36)));
    const auto whole = [&](int bound) { return std::floor(random.uniform(-bound, bound)); };
    TreeSpace space;
    space.base = {whole(8), whole(8), whole(8)};
    space.extent = 2;
    const Vec3 corner = unit * Vec3{whole(64), whole(64), whole(64)};
    const Vec3 sizes = unit * Vec3{std::abs(whole(9)), std::abs(whole(9)), std::abs(whole(9))};
    const Vec3 step{whole(3), whole(3), whole(3)};
    if (step == Vec3{}) continue;
    const double steps = std::ldexp(unit, static_cast<int>(random.below(39)));

    // As bvh_build.cpp stores it; the corner is the one that is met first, or last.
    TreeNode node{};
    const double sign = random.flip() ? 1 : -1;
    for (int axis = 0; axis != 3; ++axis) {
      const double other = corner[axis] + (step[axis] < 0 ? -sign : sign) * sizes[axis];
      node.bounds[axis][0][0] = TreeSpace::down(std::min(corner[axis], other));
      node.bounds[axis][1][0] = TreeSpace::up(std::max(corner[axis], other));
    }
    const Ray ray{.origin = space.base + (corner - steps * step), .direction = step};
    if (ray.origin - space.base != corner - steps * step) continue;
    const TreeRay tree_ray(space, ray, look_bounds(norm_of(step), 1).inverse_length);
    ++tried;
    float entry = -1;
    const float latest = tree_ray.t_of(steps);
    lost += !meets_child(node, 0, tree_ray, latest, entry) || !(0 <= entry && entry <= latest * TreeRay::kSlack);
  }
  BOOST_TEST(lost == 0);
  BOOST_TEST(tried > 20000);
}

// Of near rays also hardly above it, or nothing would ever be left out.
BOOST_AUTO_TEST_CASE(distances_in_the_tree_are_rounded_up) {
  Random random(106);
  int below = 0;
  int far_above = 0;
  for (int i = 0; i != 40000; ++i) {
    TreeSpace space;
    space.scale = std::ldexp(1.0, static_cast<int>(random.below(600)) - 300);
    space.base = (1 / space.scale) * random.in_box(10);
    space.middle = random.in_box(0.5);
    space.extent = random.uniform(0.25, 1.7);
    const double distance = random.over_decades(0.1, 1e12) / space.scale;
    const double size = random.over_decades(1e-28, 1e28);
    const Ray ray{.origin = space.base + distance * random.direction(), .direction = size * random.direction()};
    const TreeRay tree_ray(space, ray, look_bounds(norm_of(ray.direction), 1).inverse_length);
    const double t = random.over_decades(1e-12, 1e13) / space.scale / size;
    using Wide = long double;
    const Wide x = ray.direction.x;
    const Wide y = ray.direction.y;
    const Wide z = ray.direction.z;
    const Wide exact = Wide{t} * std::sqrt(x * x + y * y + z * z) * Wide{space.scale} - Wide{tree_ray.t_shift};
    const Wide rounded = tree_ray.t_of(t);
    below += rounded < exact;
    far_above += tree_ray.t_shift == 0 && rounded > exact * (1 + 0x1p-21) + 0x1p-38;
  }
  BOOST_TEST(below == 0);
  BOOST_TEST(far_above == 0);
}

// In extended precision, which knows them to 2^-60 or so.
BOOST_AUTO_TEST_CASE(scene_distances_are_rounded_up_and_down) {
  Random random(108);
  TreeSpace space;
  space.scale = 0x1p-3;
  space.extent = 1;
  for (int i = 0; i != 20000; ++i) {
    const Vec3 d = random.over_decades(1e-9, 1e9) * random.direction();
    const Ray ray{.origin = random.over_decades(1e-3, 1e9) * random.direction(), .direction = d};
    const TreeRay tree_ray(space, ray, 1 / length(d));
    const double shift = TreeRay::start_of(space, ray, 1 / length(d)).shift;
    // From the ray's start in the tree to a little farther, and to far away
    const double t = (shift + random.over_decades(1e-9, 1e9)) / (space.scale * length(d));
    const long double squared =
        static_cast<long double>(d.x) * d.x + static_cast<long double>(d.y) * d.y + static_cast<long double>(d.z) * d.z;
    const long double exact = static_cast<long double>(t) * space.scale * std::sqrt(squared) - shift;
    BOOST_REQUIRE(tree_ray.least_t_of(t) <= exact);
    BOOST_REQUIRE(exact <= tree_ray.t_of(t));
    BOOST_REQUIRE(tree_ray.t_of(t) - tree_ray.least_t_of(t) <= 0x1p-20L * exact + 0x1p-38L + 0x1p-46L * shift);
  }
}

BOOST_AUTO_TEST_SUITE_END()
