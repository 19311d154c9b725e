// SPDX-License-Identifier: BSD-3-Clause
// Radiances against the whole model in quad precision, on scenes of every kind.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/quad_oracle.h"
#include "render/reference/quad_tracer.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"
#include "render/signature_observer.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

/// Compares radiances ray by ray. A ray is off where an edge (of a shadow, a reflection, a cell) lies between the two.
struct RadianceCheck {
  Scene scene;
  int rays = 0;
  int off = 0;
  int other_decisions = 0;
  double error = 0;  ///< largest of the rays that are not off
  double brightest = 0;

  explicit RadianceCheck(const SceneData& data) : scene(data, Kernel::automatic) {}

  void trace(const Vec3& eye, const Vec3& direction) {
    Signature signature;
    SignatureObserver observer(signature);
    PathObserver* const observers[] = {&observer};
    RayCounts counts;
    const Rgb seen = seen_from(scene, eye, direction, counts, observers);
    Signature exact_signature;
    RayCounts exact_counts;
    const QuadVec exact = QuadTracer(scene.view(), eye, direction).radiance(exact_signature, exact_counts);
    other_decisions += !(signature == exact_signature && counts == exact_counts);
    const double e = std::max({error_of(seen.r, exact.x), error_of(seen.g, exact.y), error_of(seen.b, exact.z)});
    ++rays;
    off += e > 1e-6;
    if (e <= 1e-6) error = std::max(error, e);
    brightest = std::max(brightest, seen.g);
  }
};

Vec3 target_in(Random& random, const SceneData& scene) {
  const Sphere& aim = scene.spheres[random.below(static_cast<std::uint32_t>(scene.spheres.size()))];
  return aim.center + random.in_box(1.5 * aim.radius);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tracer_reference)

// Camera rays and one bounce: COUNT(0), and errors near rounding, of which the scene at 1e6 has a million times more.
BOOST_AUTO_TEST_CASE(random_scenes_match_with_one_bounce) {
  std::size_t lit = 0;
  for (const SceneKind& kind : scene_kinds()) {
    for (const Shade shade : {Shade::phong, Shade::blinn}) {
      SceneData data = random_scene(kind, shade == Shade::phong ? 161 : 162);
      data.image.max_bounces = 1;
      data.image.shade = shade;
      RadianceCheck check(data);
      Random random(161);
      for (int i = 0; i != 200; ++i) {
        const Vec3 eye = kind.center + random.in_box((i % 2 == 0 ? 1.0 : 4.0) * kind.size);
        check.trace(eye, target_in(random, data) - eye);
      }
      BOOST_TEST_MESSAGE(kind.name << ": " << check.off << " off, error " << check.error);
      BOOST_TEST(check.other_decisions == 0, kind.name << ": " << check.other_decisions << " other decisions");
      BOOST_TEST(check.off == 0, kind.name << ": " << check.off << " of " << check.rays << " rays off");
      BOOST_TEST(check.error <= 1e-12 * (1 + length(kind.center)), kind.name << ": " << check.error);
      lit += check.brightest > 0.2;
    }
  }
  BOOST_TEST(lit >= 2 * scene_kinds().size() - 2);
}

// A room of plain surfaces and few mirrors, five bounces deep.
BOOST_AUTO_TEST_CASE(closed_room_matches_with_five_bounces) {
  RadianceCheck check(random_scene(scene_kinds().back(), 163));
  Random random(163);
  for (int i = 0; i != 500; ++i) check.trace(random.in_box(5), random.direction());
  BOOST_TEST_MESSAGE("closed room: " << check.off << " off, error " << check.error);
  BOOST_TEST(check.off == 0);
  BOOST_TEST(check.other_decisions == 0);
}

// View and light through the contact of two spheres: no leak, no acne, on matte and on mirror spheres.
BOOST_AUTO_TEST_CASE(neighbourhood_of_a_contact_matches) {
  for (const double reflection : {0.0, 0.5}) {
    SceneData data;
    data.environment.background = {0, 0.5, 0};
    Material material = matte();
    material.reflection = reflection;
    add_sphere(data, {-1, 0, 0}, 1, material);
    add_sphere(data, {1, 0, 0}, 1, material);
    add_point_light(data, {0, -5, 0});
    add_point_light(data, {0.1, 7, 1});
    data.image.max_bounces = 2;
    RadianceCheck check(data);
    Random random(164);
    for (int i = 0; i != 2000; ++i) {
      const double blur = random.over_decades(1e-4, 1);
      const Vec3 eye{0.5 * random.uniform(), 5, random.uniform(-1, 1)};
      check.trace(eye, blur * random.in_box(1) - eye);
    }
    BOOST_TEST_MESSAGE("contact: " << check.off << " off, error " << check.error);
    BOOST_TEST(check.off == 0);
    BOOST_TEST(check.other_decisions == 0);
    BOOST_TEST(check.other_decisions == 0);
  }
}

// Lights on and in surfaces: all the special cases at once, from eyes inside and outside.
BOOST_AUTO_TEST_CASE(lights_on_and_in_surfaces_match) {
  SceneData data;
  const Material material{.color = {0.5, 0.75, 1}, .ambient = 0.125, .diffuse = 1, .specular = 0.5, .shininess = 5};
  add_sphere(data, {0, 0, 0}, 5, material);
  add_sphere(data, {1, 0, 0}, 1, material);
  add_sphere(data, {0, 0, 20}, 5, material);
  add_plane(data, {0, 0, -8}, {0, 0, 1}, material);
  add_point_light(data, {0.5, 2, 0});      // in the large sphere
  add_point_light(data, {1, 0.25, 0.25});  // in the small sphere within
  add_point_light(data, {40, 10, 30});     // outside
  add_directional_light(data, {1, 0, 0});  // along the plane
  RadianceCheck check(data);
  Random random(165);
  for (int i = 0; i != 2000; ++i) check.trace(random.in_box(i % 2 == 0 ? 2 : 30), random.direction());
  BOOST_TEST_MESSAGE("lights in surfaces: " << check.off << " off, error " << check.error);
  BOOST_TEST(check.off == 0);
  BOOST_TEST(check.other_decisions == 0);
  BOOST_TEST(check.error <= 1e-12);
  BOOST_TEST(check.brightest > 1);
}

// Eye exactly on a surface, looking everywhere.
BOOST_AUTO_TEST_CASE(eyes_on_surfaces_match) {
  SceneData data = random_scene(scene_kinds().front(), 167);
  add_sphere(data, {0, 0, 0}, 5, glowing({1, 0.5, 0.25}, 0.5));
  add_plane(data, {0, 0, 4}, {0, 0, 1}, glowing({0, 0.5, 0.25}, 0.25));
  RadianceCheck check(data);
  Random random(167);
  for (int i = 0; i != 1500; ++i) {
    check.trace({3, 4, 0}, random.direction());
    check.trace({-3, 0, 4}, random.direction());
    check.trace({0, 5, 0}, {random.flip() ? 1.0 : -1.0, 0, random.uniform(-1, 1)});
  }
  BOOST_TEST_MESSAGE("eyes on surfaces: " << check.off << " off, error " << check.error);
  BOOST_TEST(check.off == 0);
  BOOST_TEST(check.other_decisions == 0);
}

BOOST_AUTO_TEST_SUITE_END()
