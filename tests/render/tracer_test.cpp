// SPDX-License-Identifier: BSD-3-Clause
// The rules of the model, one by one.
#include "render/tracer.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/scene_fixture.h"
#include "render/scene_kinds.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr Vec3 kEye{-9, 0, 0};
constexpr Vec3 kAhead{1, 0, 0};

bool is_near(const Rgb& a, const Rgb& b, double tolerance) {
  return std::abs(a.r - b.r) <= tolerance && std::abs(a.g - b.g) <= tolerance && std::abs(a.b - b.b) <= tolerance;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tracer)

BOOST_AUTO_TEST_CASE(ray_that_misses_everything_sees_the_background) {
  SceneData scene;
  scene.environment.background = {0.25, 0.5, 7};
  BOOST_TEST((seen_from(scene, kEye, kAhead) == Rgb{0.25, 0.5, 7}));
  add_sphere(scene, {0, 5, 0}, 1);
  BOOST_TEST((seen_from(scene, kEye, kAhead) == Rgb{0.25, 0.5, 7}));
}

// environment.ambient ambient color, channel by channel
BOOST_AUTO_TEST_CASE(scene_without_lights_shows_the_ambient_term) {
  SceneData scene;
  scene.environment.ambient = {1, 0.5, 2};
  add_sphere(scene, {0, 0, 0}, 1, {.color = {0.5, 0.25, 1}, .ambient = 0.5, .diffuse = 1, .specular = 1});
  BOOST_TEST((seen_from(scene, kEye, kAhead) == Rgb{0.25, 0.0625, 1}));
}

// Light 4 to the side and 3 in front of (-1, 0, 0): N.L = 3 / 5; L, N and V at the same point.
BOOST_AUTO_TEST_CASE(point_light_has_no_fall_off) {
  for (const double distance : {1.0, 1e3, 1e6}) {
    SceneData scene;
    add_sphere(scene, {0, 0, 0}, 1);
    add_point_light(scene, {-1 - 3 * distance, 4 * distance, 0}, {1, 2, 3});
    BOOST_TEST(is_near(seen_from(scene, kEye, kAhead), {0.6, 1.2, 1.8}, 1e-15));
  }
}

// `direction` is the way the light travels, of any length.
BOOST_AUTO_TEST_CASE(directional_light_comes_from_where_it_travels_from) {
  for (const double length : {1e-3, 1.0, 1e3}) {
    SceneData scene;
    add_sphere(scene, {0, 0, 0}, 1);
    add_directional_light(scene, {3 * length, 0, -4 * length});
    BOOST_TEST(is_near(seen_from(scene, kEye, kAhead), {0.6, 0.6, 0.6}, 1e-15));
    scene.lights[0].vector = -scene.lights[0].vector;
    BOOST_TEST((seen_from(scene, kEye, kAhead) == Rgb{}));
  }
}

BOOST_AUTO_TEST_CASE(lights_add) {
  SceneData scene;
  add_sphere(scene, {0, 0, 0}, 1);
  add_directional_light(scene, {1, 0, 0}, {0.25, 0, 0});
  add_directional_light(scene, {1, 0, 0}, {0, 0.5, 0});
  add_point_light(scene, kEye, {0.125, 0, 1});
  BOOST_TEST((seen_from(scene, kEye, kAhead) == Rgb{0.375, 0.5, 1}));
}

// 10,000 lights of 1/5000: 2 within 1e-12.
BOOST_AUTO_TEST_CASE(ten_thousand_weak_lights_add_up) {
  SceneData scene;
  add_plane(scene, {0, 0, 0}, {-1, 0, 0});
  for (int i = 0; i != 10000; ++i) add_directional_light(scene, {1, 0, 0}, {2e-4, 2e-4, 2e-4});
  BOOST_TEST(is_near(seen_from(scene, kEye, kAhead), {2, 2, 2}, 1e-12));
}

// The same light and the same eye on either side of a plane and of a thin wall of a sphere.
BOOST_AUTO_TEST_CASE(surfaces_are_shaded_alike_on_both_sides) {
  for (const double side : {1.0, -1.0}) {
    for (const double normal : {1.0, -3.0}) {
      SceneData scene;
      add_plane(scene, {0, 0, 0}, {normal, 0, 0});
      add_point_light(scene, {3 * side, 4, 0});
      BOOST_TEST(is_near(seen_from(scene, {9 * side, 0, 0}, {-side, 0, 0}), {0.6, 0.6, 0.6}, 1e-15));
    }
  }
  SceneData ball;
  add_sphere(ball, {0, 0, 0}, 5);
  add_point_light(ball, {2, 4, 0});
  BOOST_TEST(is_near(seen_from(ball, {0, 0, 0}, kAhead), {0.6, 0.6, 0.6}, 1e-15));
}

// A light past the surface's horizon adds nothing, not even a highlight of shininess 0.
BOOST_AUTO_TEST_CASE(light_behind_the_surface_adds_nothing) {
  SceneData scene;
  Material material = glowing({0.25, 0.25, 0.25});
  material.specular = 1;
  material.diffuse = 1;
  material.shininess = 0;
  add_plane(scene, {0, 0, 0}, {1, 0, 0}, material);
  add_point_light(scene, {1, 1, 0});
  add_point_light(scene, {0, 5, 0});
  add_directional_light(scene, {-1, 1, 0});
  add_directional_light(scene, {0, 1, 0});
  BOOST_TEST((seen_from(scene, kEye, kAhead) == Rgb{0.25, 0.25, 0.25}));
}

// Colours above 1, a light of 1e30, shininess 0 and 1e6: relative error 16 u (1 + shininess).
BOOST_AUTO_TEST_CASE(large_values_keep_their_digits) {
  for (const double shininess : {0.0, 1.0, 1e6}) {
    SceneData scene;
    const Material material{.color = {7, 8, 9}, .ambient = 0, .diffuse = 1, .specular = 1, .shininess = shininess};
    add_sphere(scene, {0, 0, 0}, 5, material);
    const Vec3 eye{-4, 3 + 1e-3, 0};
    add_point_light(scene, eye + Vec3{-100, 0, 0}, {1e30, 1e30, 1e30});
    const Rgb seen = seen_from(scene, eye + Vec3{-100, 0, 0}, kAhead);
    const long double sine = (3.0L + 1e-3L) / 5;
    const long double cosine = std::sqrt(1 - sine * sine);
    const long double expected = 1e30L * (7 * cosine + std::pow(2 * cosine * cosine - 1, shininess));
    BOOST_TEST(std::abs(static_cast<double>(seen.r / expected - 1)) <= 16 * 0x1p-53 * (1 + shininess));
  }
}

// No radiance is above the larger of the background and the largest local term: all are convex combinations.
BOOST_AUTO_TEST_CASE(radiance_is_bounded_by_its_parts) {
  for (const SceneKind& kind : scene_kinds()) {
    const Scene scene(random_scene(kind, 121), Kernel::automatic);
    double bound = 0.3;
    for (const Material& m : scene.view().materials)
      bound = std::max(bound, m.ambient + 1.2 * (m.diffuse + m.specular));
    Random random(121);
    double most = 0;
    double least = 1;
    for (int i = 0; i != 2000; ++i) {
      const Rgb seen = seen_from(scene, kind.center + random.in_box(2 * kind.size), random.direction());
      most = std::max({most, seen.r, seen.g, seen.b});
      least = std::min({least, seen.r, seen.g, seen.b});
    }
    BOOST_TEST(least >= 0);
    BOOST_TEST(most <= bound * (1 + 1e-14));
  }
}

BOOST_AUTO_TEST_SUITE_END()
