// SPDX-License-Identifier: BSD-3-Clause
// Hits against the model in quad precision: no wrong surface, and distances that keep their digits.
#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "render/quad_oracle.h"
#include "render/reference/quad_tracer.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

/// Sends camera rays through both tracers.
struct HitCheck {
  Scene scene;
  int hits = 0;
  int wrong = 0;       ///< other surface, or hit for miss
  double t_error = 0;  ///< of the distance from the eye
  double normal_error = 0;

  explicit HitCheck(const SceneData& data) : scene(data, Kernel::automatic) {}

  void trace(const Vec3& eye, const Vec3& direction) {
    const auto hit = hit_from(scene, eye, direction);
    const auto exact = QuadTracer(scene.view(), eye, direction).first_hit();
    if (!hit || !exact || index_of(hit->surface) != exact->surface) {
      wrong += hit.has_value() != exact.has_value() || hit.has_value();
      return;
    }
    ++hits;
    t_error = std::max(t_error, error_of(hit->t, exact->t) / (1e-300 + hit->t));
    const double outward = static_cast<double>(quad_dot(exact->normal, hit->normal)) < 0 ? -1 : 1;
    normal_error = std::max(normal_error, error_of(outward * hit->normal, exact->normal));
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(intersect_stress)

// Off centre in a sphere every ray leaves by the far root.
BOOST_AUTO_TEST_CASE(eye_inside_a_sphere_off_centre_sees_the_far_wall) {
  for (const double off : {0.0, 0.1, 0.9, 0.999, 0.999999}) {
    SceneData data;
    add_sphere(data, {0.25, -0.5, 3}, 1);
    HitCheck check(data);
    Random random(61);
    for (int i = 0; i != 2000; ++i) check.trace(Vec3{0.25, -0.5, 3} + off * random.direction(), random.direction());
    BOOST_TEST(check.hits == 2000);
    BOOST_TEST(check.t_error * (1 - off) <= 1e-15, "off " << off << ": " << check.t_error);
  }
}

// Outside the outer of two concentric shells wins, inside the inner.
BOOST_AUTO_TEST_CASE(concentric_shells_hide_each_other) {
  for (const double gap : {1e-1, 1e-3, 1e-6}) {
    for (const bool outer_first : {false, true}) {
      SceneData data;
      const Vec3 center{0.5, 0.25, 1};
      add_sphere(data, center, outer_first ? 1 + gap : 1);
      add_sphere(data, center, outer_first ? 1 : 1 + gap);
      const SurfaceId outer = surface_id(outer_first ? 0 : 1);
      const SurfaceId inner = surface_id(outer_first ? 1 : 0);
      const Scene scene(data, Kernel::automatic);
      Random random(62);
      int wrong = 0;
      for (int i = 0; i != 2000; ++i) {
        const Vec3 eye = center + random.uniform(1.5, 100) * random.direction();
        const auto from_outside = hit_from(scene, eye, center + 0.57 * random.in_box(1) - eye);
        const auto from_inside = hit_from(scene, center + 0.57 * random.in_box(1), random.direction());
        wrong += !from_outside || from_outside->surface != outer || !from_inside || from_inside->surface != inner;
      }
      BOOST_TEST(wrong == 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(ten_spheres_deep_in_overlap_show_the_right_one) {
  Random random(63);
  for (int trial = 0; trial != 20; ++trial) {
    SceneData data;
    for (int i = 0; i != 10; ++i) add_sphere(data, 0.3 * random.in_box(1), random.uniform(0.8, 1));
    HitCheck check(data);
    for (int i = 0; i != 300; ++i) check.trace(random.in_box(i % 2 == 0 ? 0.3 : 3), random.direction());
    BOOST_TEST(check.wrong == 0);
    BOOST_TEST(check.hits > 100);
  }
}

// A fan of rays through the very contact of two spheres, in the plane between them: tangent to both, t = 1.
BOOST_AUTO_TEST_CASE(no_ray_leaks_through_the_contact_of_two_spheres) {
  SceneData data;
  add_sphere(data, {-1, 0, 0}, 1);
  add_sphere(data, {1, 0, 0}, 1);
  const Scene scene(data, Kernel::automatic);
  Random random(64);
  int leaks = 0;
  for (int i = 0; i != 20000; ++i) {
    const Vec3 eye{0, random.uniform(-9, 9), random.uniform(-9, 9)};
    const auto hit = hit_from(scene, eye, -eye);
    leaks += !hit || hit->surface != surface_id(0) || hit->t != 1;
  }
  BOOST_TEST(leaks == 0);
}

// A convex body is left for good: from rounded points, in grazing directions, at scales of 1e+-8 and far from the
// origin, where the rounded point is inside as often as not.
BOOST_AUTO_TEST_CASE(ray_leaving_a_sphere_never_meets_it_again) {
  Random random(66);
  int self_hits = 0;
  int occluded = 0;
  for (int i = 0; i != 300; ++i) {
    SceneData data;
    const double radius = random.over_decades(1e-8, 1e8);
    const Vec3 center = radius * random.over_decades(1, 1e9) * random.direction();
    add_sphere(data, center, radius);
    add_directional_light(data, {1, 0, 0});
    const Scene scene(data, Kernel::automatic);
    const Region outside = region_at(scene, {0, 0, 0}, -center);
    for (int j = 0; j != 50; ++j) {
      const Vec3 normal = random.direction();
      const Vec3 direction = random.perpendicular_to(normal) + random.over_decades(1e-17, 1) * normal;
      const Ray ray{center + radius * normal, direction, surface_id(0), normal};
      self_hits += nearest_hit(scene, ray, outside).has_value();
      occluded += is_occluded(scene, ray, 0, outside);
    }
  }
  BOOST_TEST(self_hits == 0);
  BOOST_TEST(occluded == 0);
}

// Every kind of scene, eyes in and around it; rays to random targets, so none is aimed at an edge.
BOOST_AUTO_TEST_CASE(random_scenes_show_the_right_surface) {
  for (const SceneKind& kind : scene_kinds()) {
    HitCheck check(random_scene(kind, 65));
    Random random(65);
    for (int i = 0; i != 600; ++i) {
      const Vec3 eye = kind.center + random.in_box((i % 2 == 0 ? 1.0 : 4.0) * kind.size);
      const Sphere& aim = check.scene.spheres()[random.below(12)];
      check.trace(eye, aim.center + random.in_box(1.5 * aim.radius) - eye);
    }
    BOOST_TEST_MESSAGE(kind.name << ": " << check.hits << " hits, t " << check.t_error << ", normal "
                                 << check.normal_error);
    BOOST_TEST(check.wrong == 0, kind.name << ": " << check.wrong << " wrong surfaces");
    BOOST_TEST(check.hits > 200, kind.name << ": " << check.hits << " hits");
    BOOST_TEST(check.t_error <= 1e-12, kind.name << ": " << check.t_error);
    BOOST_TEST(check.normal_error <= 1e-13, kind.name << ": " << check.normal_error);
  }
}

BOOST_AUTO_TEST_SUITE_END()
