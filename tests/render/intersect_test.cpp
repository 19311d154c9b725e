// SPDX-License-Identifier: BSD-3-Clause
#include "render/intersect.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/random.h"
#include "render/scene_fixture.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

SurfaceId surface_from(const SceneData& data, const Vec3& eye, const Vec3& direction) {
  const auto in_tree = hit_from(Scene(data, Kernel::automatic), eye, direction);
  const auto in_brute = hit_from(Scene(data, Kernel::brute), eye, direction);
  BOOST_TEST((in_tree.has_value() == in_brute.has_value() && (!in_tree || in_tree->surface == in_brute->surface)));
  return in_tree ? in_tree->surface : SurfaceId::none;
}

SceneData one_sphere(const Vec3& center, double radius) {
  SceneData scene;
  add_sphere(scene, center, radius);
  return scene;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(intersect)

// From x = -9: spheres enter at 3, 7 and 11.
BOOST_AUTO_TEST_CASE(nearest_of_several_wins) {
  SceneData scene;
  for (const double x : {3.0, -5.0, -1.0}) add_sphere(scene, {x, 0, 0}, 1);
  const auto hit = hit_from(Scene(scene, Kernel::automatic), {-9, 0, 0}, {1, 0, 0});
  BOOST_REQUIRE(hit.has_value());
  BOOST_TEST((hit->surface == surface_id(1)));
  BOOST_TEST(hit->t == 3);
  BOOST_TEST((hit->point == Vec3{-6, 0, 0}));
  BOOST_TEST((hit->normal == Vec3{-1, 0, 0}));
}

BOOST_AUTO_TEST_CASE(t_counts_lengths_of_the_direction) {
  const Scene scene(one_sphere({0, 0, 0}, 1), Kernel::automatic);
  BOOST_TEST(hit_from(scene, {-9, 0, 0}, {4, 0, 0})->t == 2);
  BOOST_TEST(hit_from(scene, {-9, 0, 0}, {0x1p-40, 0, 0})->t == 0x1p43);
}

BOOST_AUTO_TEST_CASE(empty_scene_is_never_hit) {
  BOOST_TEST((surface_from({}, {0, 0, 0}, {1, 2, 3}) == SurfaceId::none));
}

BOOST_AUTO_TEST_CASE(coincident_duplicates_show_the_lowest_index) {
  SceneData scene;
  for (const double x : {9.0, 0.0, 0.0, 0.0, 9.0}) add_sphere(scene, {x, 1, 2}, 1);
  BOOST_TEST((surface_from(scene, {-9, 1, 2}, {1, 0, 0}) == surface_id(1)));
  BOOST_TEST((surface_from(scene, {-9, 1.7, 2}, {1, 0, 0}) == surface_id(1)));
  BOOST_TEST((surface_from(scene, {0, 1, 2}, {-1, 0, 0.5}) == surface_id(1)));
}

// From within a sphere of radius 5 another one touches it from outside at (5, 0, 0): both at t = 5.
BOOST_AUTO_TEST_CASE(far_root_and_near_root_at_one_point_tie) {
  const Sphere around{{0, 0, 0}, 5};
  const Sphere beyond{{6, 0, 0}, 1};
  for (const std::vector<Sphere>& spheres : {std::vector{around, beyond}, std::vector{beyond, around}}) {
    SceneData scene;
    scene.spheres = spheres;
    BOOST_TEST((surface_from(scene, {0, 0, 0}, {1, 0, 0}) == surface_id(0)));
  }
}

BOOST_AUTO_TEST_CASE(sphere_wins_a_tie_with_a_plane) {
  SceneData scene;
  add_plane(scene, {-1, 0, 0}, {1, 0, 0});
  add_sphere(scene, {0, 0, 0}, 1);
  BOOST_TEST((surface_from(scene, {-9, 0, 0}, {1, 0, 0}) == surface_id(0)));
  BOOST_TEST((surface_from(scene, {-9, 0.5, 0}, {1, 0, 0}) == surface_id(1)));
}

BOOST_AUTO_TEST_CASE(lower_of_two_equal_planes_wins) {
  SceneData scene;
  add_plane(scene, {0, 0, 0}, {0, 0, 1});
  add_plane(scene, {0, 0, 0}, {0, 0, -1});
  BOOST_TEST((surface_from(scene, {1, 2, 3}, {0, 0, -1}) == surface_id(0)));
}

BOOST_AUTO_TEST_CASE(sphere_of_radius_zero_is_never_hit) {
  const SceneData scene = one_sphere({0, 0, 0}, 0);
  BOOST_TEST((surface_from(scene, {-9, 0, 0}, {1, 0, 0}) == SurfaceId::none));
  BOOST_TEST((surface_from(scene, {0, 0, 0}, {1, 0, 0}) == SurfaceId::none));
}

// Outside the near side, inside the far side: t = 8 and t = 1.
BOOST_AUTO_TEST_CASE(spheres_are_two_sided) {
  const Scene scene(one_sphere({0, 0, 0}, 1), Kernel::automatic);
  BOOST_TEST(hit_from(scene, {-9, 0, 0}, {1, 0, 0})->t == 8);
  const auto inside = hit_from(scene, {0, 0, 0}, {1, 0, 0});
  BOOST_TEST(inside->t == 1);
  BOOST_TEST((inside->normal == Vec3{1, 0, 0}), "the normal stays outward");
}

BOOST_AUTO_TEST_CASE(planes_are_two_sided_and_keep_their_normal) {
  SceneData data;
  add_plane(data, {5, 5, 1}, {0, 0, 4});
  const Scene scene(data, Kernel::automatic);
  const auto above = hit_from(scene, {0, 0, 3}, {1, 0, -2});
  BOOST_TEST(above->t == 1);
  BOOST_TEST((above->point == Vec3{1, 0, 1}));
  BOOST_TEST((above->normal == Vec3{0, 0, 1}));
  BOOST_TEST((hit_from(scene, {0, 0, -3}, {0, 0, 1})->normal == Vec3{0, 0, 1}));
  BOOST_TEST(!hit_from(scene, {0, 0, 3}, {0, 0, 1}).has_value());
  BOOST_TEST(!hit_from(scene, {0, 0, 3}, {1, 0, 0}).has_value());
}

// Own sphere unseen looking out and along; looking in, the far wall at t = 2 r N.d (d unit).
BOOST_AUTO_TEST_CASE(eye_exactly_on_a_surface_has_left_it) {
  const SceneData scene = one_sphere({0, 0, 0}, 5);
  const Vec3 eye{3, 4, 0};
  for (const Vec3& out : {Vec3{3, 4, 0}, Vec3{1, 0, 0}, Vec3{-4, 3, 0}, Vec3{4, -3, 0}, Vec3{0, 0, 1}}) {
    BOOST_TEST((surface_from(scene, eye, out) == SurfaceId::none));
  }
  for (const Vec3& in : {Vec3{-0.6, -0.8, 0}, Vec3{-1, 0, 0}, Vec3{0.28, -0.96, 0}, Vec3{-0.6, 0, 0.8}}) {
    const auto hit = hit_from(Scene(scene, Kernel::automatic), eye, in);
    BOOST_REQUIRE(hit.has_value());
    BOOST_TEST(std::abs(hit->t + 2 * dot(eye, in)) <= 1e-14 * hit->t);
  }
}

BOOST_AUTO_TEST_CASE(eye_exactly_on_a_plane_has_left_it) {
  SceneData scene;
  add_plane(scene, {0, 0, 2}, {0, 0, 1});
  for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}}) {
    BOOST_TEST((surface_from(scene, {4, 4, 2}, direction) == SurfaceId::none));
  }
}

// A lower sphere of a touching pair stops a ray at the common point, t = 5 for both.
BOOST_AUTO_TEST_CASE(ray_through_the_contact_of_two_spheres_hits_the_first) {
  SceneData scene;
  add_sphere(scene, {1, 0, 0}, 1);
  add_sphere(scene, {-1, 0, 0}, 1);
  const auto hit = hit_from(Scene(scene, Kernel::automatic), {0, 5, 0}, {0, -1, 0});
  BOOST_REQUIRE(hit.has_value());
  BOOST_TEST((hit->surface == surface_id(0)));
  BOOST_TEST(hit->t == 5);
  BOOST_TEST((hit->normal == Vec3{-1, 0, 0}));
}

// Left along a tangent from a rounded point, the other of two coincident spheres would be met at once.
BOOST_AUTO_TEST_CASE(sphere_that_coincides_with_the_one_left_is_not_met) {
  Random random(45);
  int met = 0;
  int hidden = 0;
  for (int i = 0; i != 2000; ++i) {
    SceneData data;
    const Vec3 center = random.in_box(1);
    add_sphere(data, center, 0.3);
    add_sphere(data, center, 0.3);
    const Scene scene(data, Kernel::automatic);
    const Vec3 normal = random.direction();
    const Ray leaving{center + 0.3 * normal, random.perpendicular_to(normal), surface_id(0), normal};
    const Region outside = region_at(scene, center + normal, normal);
    met += nearest_hit(scene, leaving, outside).has_value();
    data.lights = {{LightKind::point, leaving.origin + leaving.direction, kWhite}};
    hidden += is_occluded(Scene(data, Kernel::automatic), leaving, 0, outside);
  }
  BOOST_TEST(met == 0);
  BOOST_TEST(hidden == 0);
}

BOOST_AUTO_TEST_SUITE_END()
