// SPDX-License-Identifier: BSD-3-Clause
#include "render/region.h"

#include <boost/test/unit_test.hpp>

#include "render/plane.h"
#include "render/quad_oracle.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

using Ids = std::vector<SurfaceId>;

// Spheres of radius 1, 5 and 13 about the origin, one of radius 0, and the floor z = -5.
SceneData shells() {
  SceneData scene;
  for (const double radius : {1.0, 5.0, 13.0, 0.0}) add_sphere(scene, {0, 0, 0}, radius);
  add_plane(scene, {7, 7, -5}, {0, 0, 2});
  return scene;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(region)

BOOST_AUTO_TEST_CASE(point_is_enclosed_by_spheres_larger_than_its_distance) {
  for (const Kernel kernel : {Kernel::automatic, Kernel::brute}) {
    const Scene scene(shells(), kernel);
    BOOST_TEST((scene.placement_of({3, 0, 0}).enclosing == Ids{surface_id(1), surface_id(2)}));
    BOOST_TEST((scene.placement_of({0, 0, 0}).enclosing == Ids{surface_id(0), surface_id(1), surface_id(2)}));
    BOOST_TEST(scene.placement_of({0, 20, 0}).enclosing.empty());
    BOOST_TEST(scene.placement_of({0, 20, 0}).touching.empty());
  }
}

// (3, 4, 0) and (0, 0, -5) are exactly on the sphere of radius 5, the latter on the floor too.
BOOST_AUTO_TEST_CASE(point_on_a_surface_touches_it) {
  const Scene scene(shells(), Kernel::automatic);
  const Placement rim = scene.placement_of({3, 4, 0});
  BOOST_TEST((rim.touching == Ids{surface_id(1)}));
  BOOST_TEST((rim.enclosing == Ids{surface_id(2)}));
  BOOST_TEST((scene.placement_of({0, 0, -5}).touching == Ids{surface_id(1), scene.plane_id(0)}));
}

// A sphere of radius 0 never encloses nor touches, not even at its centre.
BOOST_AUTO_TEST_CASE(sphere_of_radius_zero_is_nowhere) {
  SceneData data;
  add_sphere(data, {1, 2, 3}, 0);
  for (const Kernel kernel : {Kernel::automatic, Kernel::brute}) {
    const Placement placement = Scene(data, kernel).placement_of({1, 2, 3});
    BOOST_TEST(placement.enclosing.empty());
    BOOST_TEST(placement.touching.empty());
  }
}

BOOST_AUTO_TEST_CASE(eye_on_a_sphere_has_left_it_to_the_side_that_the_ray_points_to) {
  const Scene scene(shells(), Kernel::automatic);
  const Vec3 eye{3, 4, 0};
  BOOST_TEST(!region_at(scene, eye, {3, 4, 0}).is_inside(surface_id(1)));
  BOOST_TEST(region_at(scene, eye, {-3, -4, 0}).is_inside(surface_id(1)));
  BOOST_TEST(region_at(scene, eye, {-3, -4, 0}).is_inside(surface_id(2)));
  BOOST_TEST(!region_at(scene, eye, {-3, -4, 0}).is_inside(surface_id(0)));
}

// A tangent line runs outside of a convex body.
BOOST_AUTO_TEST_CASE(eye_on_a_sphere_looking_along_it_is_outside) {
  const Scene scene(shells(), Kernel::automatic);
  BOOST_TEST(!region_at(scene, {3, 4, 0}, {-4, 3, 0}).is_inside(surface_id(1)));
  BOOST_TEST(!region_at(scene, {3, 4, 0}, {0, 0, 1}).is_inside(surface_id(1)));
}

BOOST_AUTO_TEST_CASE(eye_on_a_plane_has_left_it_to_the_side_that_the_ray_points_to) {
  const Scene scene(shells(), Kernel::automatic);
  BOOST_TEST(region_at(scene, {40, 0, 9}, {0, 0, -1}).side_of(0) == 1);
  BOOST_TEST(region_at(scene, {40, 0, -9}, {0, 0, 1}).side_of(0) == -1);
  BOOST_TEST(region_at(scene, {40, 0, -5}, {1, 0, 1}).side_of(0) == 1);
  BOOST_TEST(region_at(scene, {40, 0, -5}, {1, 0, -1}).side_of(0) == -1);
}

BOOST_AUTO_TEST_CASE(side_of_a_plane_ignores_the_length_of_its_normal) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const Plane plane{{1, 1, 1}, scale * Vec3{1, 2, -2}, {}, {}};
    BOOST_TEST(side_of({2, 1, 1}, plane) == 1);
    BOOST_TEST(side_of({1, 1, 2}, plane) == -1);
    BOOST_TEST(side_of({3, 2, 3}, plane) == 0);
  }
}

// Inside, on and outside as quad precision decides, for points on a grid of small integers, where it is exact.
BOOST_AUTO_TEST_CASE(placement_agrees_with_exact_arithmetic) {
  SceneData data;
  Random random(41);
  const auto small = [&] { return static_cast<double>(random.below(13)) - 6; };
  for (int i = 0; i != 60; ++i) add_sphere(data, {small(), small(), small()}, random.below(7));
  const Scene tree(data, Kernel::automatic);
  const Scene brute(data, Kernel::brute);
  int wrong = 0;
  std::size_t touching = 0;
  for (int i = 0; i != 2000; ++i) {
    const Vec3 point{small(), small(), small()};
    Placement expected;
    for (std::size_t s = 0; s != data.spheres.size(); ++s) {
      const Sphere& sphere = data.spheres[s];
      const Vec3 f = sphere.center - point;
      const double power = dot(f, f) - sphere.radius * sphere.radius;
      if (sphere.radius > 0 && power < 0) expected.enclosing.push_back(surface_id(s));
      if (sphere.radius > 0 && power == 0) expected.touching.push_back(surface_id(s));
    }
    touching += expected.touching.size();
    for (const Scene* scene : {&tree, &brute}) {
      const Placement placement = scene->placement_of(point);
      wrong += placement.enclosing != expected.enclosing || placement.touching != expected.touching;
    }
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(touching > 500U);
}

// Half a million about one centre, each twice: work that grew with the square of their number would take many minutes.
BOOST_AUTO_TEST_CASE(of_very_many_coincident_spheres_around_the_eye_the_first_are_walls) {
  constexpr std::size_t kCount = 500000;
  SceneData data;
  add_material(data, matte());
  for (std::size_t i = 0; i != 2 * kCount; ++i) {
    data.spheres.push_back({{0.25, 0, 0}, 1 + static_cast<double>(i % kCount * 7919 % kCount), MaterialIndex{0}});
  }
  const Scene scene(data, Kernel::brute);
  const Region region = region_at(scene, {0.25, 0.5, 0}, {1, 0, 0});
  BOOST_TEST(region.is_inside(surface_id(2 * kCount - 1)));
  BOOST_TEST_REQUIRE(region.walls().size() == kCount);
  for (std::size_t i = 0; i != kCount; ++i) {
    if (region.walls()[i] != surface_id(i)) BOOST_ERROR("wall " << i);
  }
}

BOOST_AUTO_TEST_SUITE_END()
