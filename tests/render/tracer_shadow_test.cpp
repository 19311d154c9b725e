// SPDX-License-Identifier: BSD-3-Clause
// Who blocks which light: the rules of the model at their edges.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/quad_oracle.h"
#include "render/random.h"
#include "render/scene_fixture.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr Rgb kAmbient{0.25, 0.25, 0.25};

/// Ambient 0.25 and diffuse 1, with a highlight that any light in front would show.
Material shaded() {
  return {.color = kWhite, .ambient = 0.25, .diffuse = 1, .specular = 1, .shininess = 0, .reflection = 0};
}

/// The last point on the way from the origin to `wall` that is strictly inside of the unit sphere.
Vec3 last_inside_unit_sphere(Vec3 wall) {
  while (!(quad_dot(wall, wall) < 1)) wall = (1 - 0x1p-53) * wall;
  return wall;
}

bool is_lit(const SceneData& data, const Vec3& eye, const Vec3& direction) {
  const Rgb in_tree = seen_from(Scene(data, Kernel::automatic), eye, direction);
  BOOST_TEST((in_tree == seen_from(Scene(data, Kernel::brute), eye, direction)));
  return in_tree != kAmbient;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tracer_shadow)

BOOST_AUTO_TEST_CASE(shadow_keeps_the_ambient_term) {
  SceneData scene;
  add_plane(scene, {0, 0, 0}, {0, 0, 1}, shaded());
  add_point_light(scene, {0, 0, 9});
  BOOST_TEST(is_lit(scene, {3, 0, 1}, {-3, 0, -1}));
  add_sphere(scene, {0, 0, 5}, 1);
  BOOST_TEST((seen_from(scene, {3, 0, 1}, {-3, 0, -1}) == kAmbient));
  scene.lights[0] = {LightKind::directional, {0, 0, -1}, kWhite};
  BOOST_TEST((seen_from(scene, {3, 0, 1}, {-3, 0, -1}) == kAmbient));
}

BOOST_AUTO_TEST_CASE(only_what_stands_before_the_light_blocks_it) {
  SceneData scene;
  add_plane(scene, {0, 0, 0}, {0, 0, 1}, shaded());
  add_sphere(scene, {0, 0, 12}, 1);
  add_point_light(scene, {0, 0, 9});
  BOOST_TEST(is_lit(scene, {3, 0, 1}, {-3, 0, -1}));
  add_plane(scene, {0, 0, 10}, {0, 0, 1});
  BOOST_TEST(is_lit(scene, {3, 0, 1}, {-3, 0, -1}));
  add_plane(scene, {0, 0, 8}, {0, 0, 1});
  BOOST_TEST(!is_lit(scene, {3, 0, 1}, {-3, 0, -1}));
}

BOOST_AUTO_TEST_CASE(sphere_of_radius_zero_casts_no_shadow) {
  SceneData scene;
  add_plane(scene, {0, 0, 0}, {0, 0, 1}, shaded());
  add_point_light(scene, {0, 0, 9});
  add_sphere(scene, {0, 0, 5}, 0);
  BOOST_TEST(is_lit(scene, {3, 0, 1}, {-3, 0, -1}));
}

// A tangent is a hit, for light too.
BOOST_AUTO_TEST_CASE(touching_sphere_blocks_the_light) {
  SceneData scene;
  add_plane(scene, {0, 0, 0}, {0, 0, 1}, shaded());
  add_point_light(scene, {0, 0, 9});
  add_sphere(scene, {1, 0, 5}, 1);
  BOOST_TEST(!is_lit(scene, {3, 0, 1}, {-3, 0, -1}));
  scene.spheres[0].radius = std::nextafter(1, 0);
  BOOST_TEST(is_lit(scene, {3, 0, 1}, {-3, 0, -1}));
}

// Wherever the light is in the sphere, whatever of the floor is asked.
BOOST_AUTO_TEST_CASE(light_inside_an_opaque_sphere_lights_nothing_outside) {
  Random random(141);
  for (const double off : {0.0, 0.5, 0.999999}) {
    SceneData scene;
    add_plane(scene, {0, 0, 0}, {0, 0, 1}, shaded());
    add_sphere(scene, {0, 0, 3}, 2, shaded());
    add_sphere(scene, {9, 0, 3}, 1, shaded());
    for (int i = 0; i != 5; ++i) add_point_light(scene, Vec3{0, 0, 3} + 2 * off * random.direction());
    int lit = 0;
    for (int i = 0; i != 500; ++i) {
      const Vec3 eye{0, -30, 4};
      const Vec3 target{random.uniform(-9, 9), random.uniform(-9, 9), 0};
      lit += is_lit(scene, eye, target - eye);
      lit += is_lit(scene, eye, Vec3{0, 0, 3} + 2 * random.direction() - eye);
      lit += is_lit(scene, eye, Vec3{9, 0, 3} + 0.5 * random.direction() - eye);
    }
    BOOST_TEST(lit == 0);
  }
}

// Light and eye in a hollow sphere: its wall blocks nothing, though the light is as close to it as doubles allow.
BOOST_AUTO_TEST_CASE(light_inside_the_sphere_around_the_eye_is_not_blocked_by_it) {
  Random random(142);
  int dark = 0;
  for (int i = 0; i != 3000; ++i) {
    const Vec3 wall = random.direction();
    SceneData data;
    add_sphere(data, {0, 0, 0}, 1);
    add_sphere(data, {0, 0, 0}, 0.25, shaded());
    add_point_light(data, last_inside_unit_sphere(wall));
    const Scene scene(data, Kernel::automatic);
    const Vec3 direction = -1.0 * (wall + 0.05 * random.in_box(1));
    dark += seen_from(scene, 0.9 * wall, direction) == kAmbient;
  }
  BOOST_TEST(dark == 0, dark << " of 3000 shadow rays blocked by the sphere around them");
}

// The same from outside: the light is in the sphere, if only just, and must not shine out.
BOOST_AUTO_TEST_CASE(light_just_inside_an_opaque_sphere_lights_nothing_outside) {
  Random random(143);
  int lit = 0;
  for (int i = 0; i != 3000; ++i) {
    const Vec3 top = random.direction();
    SceneData data;
    add_sphere(data, {0, 0, 0}, 1);
    add_plane(data, 2 * top, top, shaded());
    add_point_light(data, last_inside_unit_sphere(top));
    const Scene scene(data, Kernel::automatic);
    const Vec3 eye = 1.5 * top;
    lit += seen_from(scene, eye, top + 0.5 * random.in_box(1)) != kAmbient;
  }
  BOOST_TEST(lit == 0, lit << " of 3000 shadow rays leave the sphere around the light");
}

// A sphere with the light at its top: lit above, dark below; itself, N.L = N.top - 1 < 0, ambient throughout.
BOOST_AUTO_TEST_CASE(light_on_a_sphere_is_not_blocked_where_it_sits) {
  SceneData scene;
  add_sphere(scene, {0, 0, 0}, 5, shaded());
  add_plane(scene, {0, 0, 20}, {0, 0, 1}, shaded());
  add_plane(scene, {0, 0, -20}, {0, 0, 1}, shaded());
  add_point_light(scene, {3, 0, 4});
  const Vec3 eye{50, 0, 0};
  BOOST_TEST(is_lit(scene, eye, Vec3{3, 0, 20} - eye));
  BOOST_TEST(is_lit(scene, eye, Vec3{-3, 2, 20} - eye));
  BOOST_TEST(!is_lit(scene, eye, Vec3{3, 0, -20} - eye));
  BOOST_TEST(!is_lit(scene, eye, Vec3{5, 0, -20} - eye));
  BOOST_TEST(!is_lit(scene, eye, Vec3{4, 0, 3} - eye));
}

// The same from everywhere above it, and from within: whatever t rounding gives to the end point, it is open.
BOOST_AUTO_TEST_CASE(light_on_a_sphere_reaches_every_point_that_sees_it) {
  Random random(144);
  int dark = 0;
  for (const Vec3& light : {Vec3{3, 0, 4}, Vec3{0, -3, 4}, Vec3{0, 0, 5}}) {
    SceneData data;
    add_sphere(data, {0, 0, 0}, 5, shaded());
    add_plane(data, {0, 0, 20}, {0, 0, 1}, shaded());
    add_point_light(data, light);
    const Scene from_outside(data, Kernel::automatic);
    data.planes.clear();
    add_sphere(data, {-1, 1, -2}, 1, shaded());
    const Scene from_inside(data, Kernel::automatic);
    for (int i = 0; i != 2000; ++i) {
      const Vec3 on_ceiling{random.uniform(-9, 9), random.uniform(-9, 9), 20};
      dark += seen_from(from_outside, on_ceiling - Vec3{0, 0, 1}, {0, 0, 1}) == kAmbient;
      const Vec3 on_ball = Vec3{-1, 1, -2} + random.direction();
      if (dot(on_ball - Vec3{-1, 1, -2}, light - on_ball) < 0.01) continue;
      const Vec3 eye = on_ball + 0.01 * (light - on_ball);
      dark += seen_from(from_inside, eye, on_ball - eye) == kAmbient;
    }
  }
  BOOST_TEST(dark == 0);
}

// Seen from above and from below, where a light lies in a plane, both sides of the room are lit.
BOOST_AUTO_TEST_CASE(light_on_a_plane_is_not_blocked_by_it) {
  for (const double side : {1.0, -1.0}) {
    SceneData scene;
    add_plane(scene, {7, 7, 0}, {0, 0, 1}, shaded());
    add_sphere(scene, {0, 0, 3 * side}, 1, shaded());
    add_point_light(scene, {0, 0, 0});
    const Vec3 eye{5, 0, 0.5 * side};
    BOOST_TEST(is_lit(scene, eye, Vec3{0.5, 0, 2.25 * side} - eye));
  }
}

// The light's place is the shaded point: no direction, no contribution, no NaN.
BOOST_AUTO_TEST_CASE(light_exactly_at_the_shaded_point_adds_nothing) {
  SceneData scene;
  add_sphere(scene, {0, 0, 0}, 1, shaded());
  add_plane(scene, {-4, 0, 0}, {1, 0, 0}, shaded());
  add_point_light(scene, {1, 0, 0});
  add_point_light(scene, {-4, 0, 0});
  add_point_light(scene, {0, -1, 0});
  BOOST_TEST(!is_lit(scene, {9, 0, 0}, {-1, 0, 0}));
  BOOST_TEST(!is_lit(scene, {-9, 0, 0}, {1, 0, 0}));
  BOOST_TEST(!is_lit(scene, {0, -9, 0}, {0, 1, 0}));
}

// Spheres touching at the origin, eye and light in the plane between them: every ray is tangent to both.
BOOST_AUTO_TEST_CASE(no_light_leaks_through_the_contact_of_two_spheres) {
  SceneData scene;
  add_sphere(scene, {-1, 0, 0}, 1, shaded());
  add_sphere(scene, {1, 0, 0}, 1, shaded());
  add_plane(scene, {0, -8, 0}, {0, 1, 0}, shaded());
  for (const double z : {0.0, 0.5, 1.0, 4.0}) {
    scene.lights = {{LightKind::point, {0, 8, z}, kWhite}};
    BOOST_TEST(!is_lit(scene, {0, -7, -z}, {0, -1, 0}));
    // The same light beside the contact reaches the floor.
    scene.lights = {{LightKind::point, {0, 8, z + 5}, kWhite}};
    BOOST_TEST(is_lit(scene, {0, -7, 5 - z}, {0, -1, 0}));
  }
}

// N.L = 0 for every point of the plane, whatever the rounded hit points say: no light, not even a highlight.
BOOST_AUTO_TEST_CASE(light_in_a_plane_does_not_light_it) {
  Random random(73);
  int lit = 0;
  for (int i = 0; i != 500; ++i) {
    SceneData data;
    const Vec3 normal{static_cast<double>(1 + random.below(5)), static_cast<double>(random.below(5)), 3};
    add_plane(data, {}, normal, {.color = kWhite, .ambient = 0.25, .diffuse = 1, .specular = 1, .shininess = 0});
    // Both at right angles to the normal, exactly: the numbers are small and whole.
    add_point_light(data, {normal.y, -normal.x, 0});
    add_directional_light(data, {3, 0, -normal.x});
    const Vec3 eye = 4 * random.direction();
    data.environment.background = {0.25, 0.25, 0.25};  // what misses the plane is unlit too
    lit += !(seen_from(data, eye, random.in_box(2) - eye) == Rgb{0.25, 0.25, 0.25});
  }
  BOOST_TEST(lit == 0);
}

BOOST_AUTO_TEST_SUITE_END()
