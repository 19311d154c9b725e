// SPDX-License-Identifier: BSD-3-Clause
// Every line of a light that may meet a sphere has a square, and is in that square's pencil whatever its width. Oracle:
// where the line meets the face, computed in double from the pencil's own vectors.
#include "render/light_grid.h"

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "render/bvh_build.h"
#include "render/random.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

TreeSpace space_of(const std::vector<Sphere>& spheres) {
  return build_bvh(spheres).space();
}

/// The coordinates of some spheres of size `extent`, their base among them, though not in the middle.
TreeSpace space_about(Random& random, const Vec3& center, double extent) {
  std::vector<Sphere> spheres;
  for (int i = 0; i != 40; ++i) {
    const double spread = i < 30 ? 0.1 * extent : extent;
    spheres.push_back({center + random.in_box(spread), extent * random.over_decades(1e-3, 0.3), MaterialIndex{0}});
  }
  return space_of(spheres);
}

/// The line of a light to a point, in scene coordinates.
LightLine line_to(const LightGrid& grid, const TreeSpace& space, const Vec3& point) {
  LightLine line{};
  const Vec3 way = space.from_scene(point) - grid.origin();
  const Vec3 unit = grid.is_point() ? normalized(way) : grid.direction();
  const double distance = dot(way, unit);
  for (int axis = 0; axis != 3; ++axis) {
    line.unit[axis] = static_cast<float>(unit[axis]);
    if (!grid.is_point()) line.across[axis] = static_cast<float>(way[axis] - distance * unit[axis]);
  }
  line.distance = static_cast<float>(distance);
  return line;
}

/// Where the line to a point goes through a pencil's face.
std::array<double, 2> crossing_of(const Pencil& pencil, const Vec3& point) {
  const Vec3 way = point - pencil.origin;
  const double ahead = pencil.kind == Pencil::Kind::pyramid ? dot(way, pencil.axis) / dot(pencil.axis, pencil.axis) : 1;
  return {dot(way, pencil.right) / dot(pencil.right, pencil.right) / ahead,
          dot(way, pencil.down) / dot(pencil.down, pencil.down) / ahead};
}

bool holds(const std::array<double, 2>& range, double x) {
  return range[0] <= x && x <= range[1];
}

/// Sends lines of a light through the spheres' ball, and counts what goes wrong.
void check_lines(const TreeSpace& space, const Light& light, std::uint32_t faces, const std::string& name) {
  const auto grid = LightGrid::of(space, light);
  BOOST_TEST_REQUIRE(grid.has_value(), name);
  BOOST_TEST(grid->faces() == faces, name);
  Random random(121);
  int lines = 0;
  int lost = 0;
  int outside = 0;
  for (int i = 0; i != 4000; ++i) {
    // In the ball, on it, behind it and, mostly for a light among the spheres, next to the light.
    Vec3 point = space.middle + space.extent * random.over_decades(1e-3, 1) * random.direction();
    if (i % 4 == 1) point = space.middle + space.extent * random.direction();
    if (i % 4 == 2) point = grid->origin() + random.over_decades(1, 8) * (point - grid->origin());
    if (i % 4 == 3 && grid->is_point()) point = grid->origin() + random.over_decades(1e-6, 1) * random.direction();
    // Where faces of a cube meet.
    if (i % 16 == 0 && faces > 1) {
      const double x = random.uniform(-1, 1);
      point = grid->origin() + (random.flip() ? Vec3{x, x, 1} : Vec3{-x, 1, x});
    }
    point = space.to_scene(point);
    const LightLine line = line_to(*grid, space, point);
    ++lines;
    const Vec3 unit{line.unit[0], line.unit[1], line.unit[2]};
    const Vec3 way = space.middle - grid->origin() - Vec3{line.across[0], line.across[1], line.across[2]};
    const Vec3 aside = way - dot(way, unit) * unit;
    const bool meets_ball = dot(way, unit) > 0 && length(aside) < space.extent * (1 - 1e-4);
    const auto place = grid->place_of(line);
    if (!place) {
      // On a cube alone a line may be lost between two faces.
      const auto near_edge = [&](double a, double b) { return std::abs(std::abs(a) - std::abs(b)) < 1e-6; };
      const bool is_between = near_edge(unit.x, unit.y) || near_edge(unit.y, unit.z) || near_edge(unit.z, unit.x);
      lost += faces == 1 ? meets_ball : !is_between;
      continue;
    }
    for (unsigned bits = 0; bits <= LightGrid::kBits; ++bits) {
      const Pencil pencil = grid->pencil(*place, bits);
      const auto [x, y] = crossing_of(pencil, point);
      outside += !holds(pencil.x, x) || !holds(pencil.y, y);
      // A little wider than its square, not much.
      const double width = 2.0 * (1U << bits) / LightGrid::kSquares;
      outside += !(pencil.x[1] - pencil.x[0] < width * 1.1 && pencil.y[1] - pencil.y[0] < width * 1.1);
    }
  }
  BOOST_TEST(lost == 0, name << ": " << lost << " of " << lines << " lines have no place");
  BOOST_TEST(outside == 0, name << ": " << outside << " of " << lines << " lines are outside of their square");
}

Light point_light(const Vec3& position) {
  return {LightKind::point, position, {1, 1, 1}};
}
Light directional_light(const Vec3& direction) {
  return {LightKind::directional, direction, {1, 1, 1}};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(light_grid)

BOOST_AUTO_TEST_CASE(lines_of_a_point_light_are_in_their_squares) {
  Random random(122);
  for (const double extent : {1.0, 0.7e-3, 3e30, 1e-60}) {
    for (const double offset : {0.0, 1e3, 1e9}) {
      const TreeSpace space = space_about(random, offset * extent * Vec3{1, -1, 0.5}, extent);
      const auto light_at = [&](double distance, const Vec3& direction) {
        return point_light(space.to_scene(space.middle + distance * space.extent * direction));
      };
      const std::string name = "extent " + std::to_string(std::log10(extent)) + ", offset " + std::to_string(offset);
      for (const double distance : {0.0, 1e-9, 1e-3, 0.5, 0.999, 1.0, 1.001, 1.4999}) {
        check_lines(space, light_at(distance, random.direction()), 6, name + ", near " + std::to_string(distance));
      }
      for (const double distance : {1.5001, 1.6, 4.0, 4.01, 10.0, 63.99}) {
        check_lines(space, light_at(distance, random.direction()), 1, name + ", far " + std::to_string(distance));
        check_lines(space, light_at(distance, {0, -1, 0}), 1, name + ", ahead " + std::to_string(distance));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(lines_of_a_directional_light_are_in_their_squares) {
  Random random(123);
  for (const double offset : {0.0, 1e3, 1e9, 1e12}) {
    const TreeSpace space = space_about(random, offset * Vec3{1, -1, 0.5}, 0.3);
    for (const double size : {1e-180, 1e-30, 1.0, 1e30, 1e180}) {
      const std::string name = "offset " + std::to_string(offset) + ", length " + std::to_string(std::log10(size));
      for (const Vec3& direction : {Vec3{1, -0.0, 0}, Vec3{-0.0, -1, 0.0}, Vec3{0, -0.0, -1}, random.direction()}) {
        check_lines(space, directional_light(size * direction), 1, name);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(scenes_and_lights_that_floats_cannot_show_have_no_grid) {
  Random random(124);
  BOOST_TEST(!LightGrid::of(TreeSpace{}, point_light({1, 2, 3})).has_value());
  BOOST_TEST(!LightGrid::of(TreeSpace{}, directional_light({1, 2, 3})).has_value());
  const TreeSpace space = space_about(random, {1, 2, 3}, 1);
  for (const double distance : {64.01, 1e3, 1e12, 1e200}) {
    BOOST_TEST(
        !LightGrid::of(space, point_light(space.to_scene(space.middle + distance * space.extent * random.direction())))
             .has_value());
  }
}

// What the light, or its way, is off by grows with the distance of what it shines on.
BOOST_AUTO_TEST_CASE(lines_to_points_far_away_have_no_place) {
  Random random(125);
  const TreeSpace space = space_about(random, {0, 0, 0}, 1);
  for (const Light& light : {point_light({5, 0, 0}), point_light({0, 0, 0}), directional_light({-1, 0, 0})}) {
    const auto grid = LightGrid::of(space, light);
    BOOST_TEST_REQUIRE(grid.has_value());
    for (const double distance : {10.0, 100.0}) {
      BOOST_TEST(grid->place_of(line_to(*grid, space, {-distance, 0.01, 0.02})).has_value(), distance);
    }
    for (const double distance : {1e4, 1e12, 1e30, 1e100}) {
      BOOST_TEST(!grid->place_of(line_to(*grid, space, {-distance, 0.01, 0.02})).has_value(), distance);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
