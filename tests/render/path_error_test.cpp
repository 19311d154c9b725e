// SPDX-License-Identifier: BSD-3-Clause
#include "render/path_error.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/quad_oracle.h"
#include "render/reference/quad_tracer.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

struct Bounded {
  Rgb radiance;
  double bound;
};

Bounded bounded_radiance(const Scene& scene, const Vec3& eye, const Vec3& direction) {
  const Region region = region_at(scene, eye, direction);
  PathError error(scene, region, scene.data().image.shade);
  PathObserver* const observers[] = {&error};
  RayCounts counts;
  const Rgb radiance = seen_from(scene, eye, direction, counts, observers);
  return {radiance, error.bound()};
}

/// Errors against quad precision, as shares of their bounds.
struct BoundCheck {
  Scene scene;
  int rays = 0;
  int certified = 0;
  int exceeded = 0;
  double closest = 0;   ///< largest error / bound
  double smallest = 1;  ///< smallest bound
  double largest = 0;   ///< largest bound

  explicit BoundCheck(const SceneData& data) : scene(data, Kernel::automatic) {}

  void trace(const Vec3& eye, const Vec3& direction) {
    ++rays;
    const auto [radiance, bound] = bounded_radiance(scene, eye, direction);
    if (std::isinf(bound)) return;
    ++certified;
    const QuadVec exact = QuadTracer(scene.view(), eye, direction).radiance();
    const double error =
        std::max({error_of(radiance.r, exact.x), error_of(radiance.g, exact.y), error_of(radiance.b, exact.z)});
    exceeded += !(error <= bound);
    closest = std::max(closest, error / bound);
    smallest = std::min(smallest, bound);
    largest = std::max(largest, bound);
  }

  void report(const std::string& name) const {
    BOOST_TEST_MESSAGE(name << ": " << certified << " of " << rays << " certified, bounds " << smallest << " to "
                            << largest << ", error at most " << closest << " of its bound");
    BOOST_TEST(exceeded == 0, name << ": " << exceeded << " errors above their bound");
  }
};

bool is_certified(const SceneData& data, const Vec3& eye, const Vec3& direction) {
  return std::isfinite(bounded_radiance(Scene(data, Kernel::automatic), eye, direction).bound);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(ErrorOfAPath)

BOOST_AUTO_TEST_CASE(no_error_exceeds_its_bound) {
  for (const SceneKind& kind : scene_kinds()) {
    for (const std::uint32_t bounces : {0u, 1u, 5u}) {
      SceneData data = random_scene(kind, 191 + bounces);
      data.image.max_bounces = bounces;
      data.image.shade = bounces == 1 ? Shade::blinn : Shade::phong;
      BoundCheck check(data);
      Random random(191);
      for (int i = 0; i != 300; ++i) {
        const Vec3 eye = kind.center + random.in_box((i % 2 == 0 ? 1.0 : 4.0) * kind.size);
        const Sphere& aim = data.spheres[random.below(static_cast<std::uint32_t>(data.spheres.size()))];
        check.trace(eye, aim.center + random.in_box(1.5 * aim.radius) - eye);
      }
      check.report(kind.name + ", " + std::to_string(bounces) + " bounces");
      BOOST_TEST(check.certified >= (bounces == 5 ? 0.5 : 0.95) * check.rays, kind.name << ": " << check.certified);
    }
  }
}

// The eye on the axis sees itself in the mirror, and beyond it a ball that touches the axis or nearly so.
BOOST_AUTO_TEST_CASE(silhouettes_within_the_error_are_uncertified) {
  const auto scene_with_ball_at = [](double y) {
    SceneData data;
    add_sphere(data, {0, 0, 0}, 1, mirror(0.5));
    add_sphere(data, {10, y, 0}, 1);
    return data;
  };
  for (const double y : {1.0, std::nextafter(1, 0), std::nextafter(1, 2), 1 + 1e-15}) {
    BOOST_TEST(!is_certified(scene_with_ball_at(y), {5, 0, 0}, {-1, 0, 0}), y);
  }
  for (const double y : {0.99, 1.0001, -1.0001}) {
    BOOST_TEST(is_certified(scene_with_ball_at(y), {5, 0, 0}, {-1, 0, 0}), y);
  }
}

// The ball's shadow ends at x = 0.
BOOST_AUTO_TEST_CASE(shadow_edges_within_the_error_are_uncertified) {
  SceneData data;
  add_plane(data, {0, 0, 0}, {0, 0, 1});
  add_sphere(data, {1, 0, 5}, 1);
  add_point_light(data, {0, 0, 10});
  const auto at = [&](double x) { return is_certified(data, {x, -3, 3}, {0, 1, -1}); };
  BOOST_TEST(!at(0));
  BOOST_TEST(!at(1e-16));
  BOOST_TEST(at(-1e-6));
  BOOST_TEST(at(1e-6));
  data.lights[0] = {LightKind::directional, {0, 0, -1}, kWhite};
  BOOST_TEST(!at(0));
  BOOST_TEST(at(-1e-6));
  BOOST_TEST(at(1e-6));
}

BOOST_AUTO_TEST_CASE(cell_edges_within_the_error_are_uncertified) {
  SceneData data;
  add_plane(data, {0, 0, 0}, {0, 0, 1});
  data.planes[0].checker = Checker{add_material(data, mirror()), 1};
  BOOST_TEST(!is_certified(data, {0.5, 2, 3}, {0, 0, -1}));
  BOOST_TEST(!is_certified(data, {3, 0.5, 3}, {0, 0, -1}));
  BOOST_TEST(is_certified(data, {3.001, 0.5, 3}, {0, 0, -1}));
}

BOOST_AUTO_TEST_CASE(terminators_within_the_error_are_uncertified) {
  SceneData data;
  add_sphere(data, {0, 0, 0}, 1);
  add_directional_light(data, {0, 0, -1});
  BOOST_TEST(!is_certified(data, {5, 0, 0}, {-1, 0, 0}));
  BOOST_TEST(is_certified(data, {5, 0, 1e-6}, {-1, 0, 0}));
  BOOST_TEST(is_certified(data, {5, 0, -1e-6}, {-1, 0, 0}));
}

// R.V = 0 where light and eye are at right angles to each other seen from the mirrored side.
BOOST_AUTO_TEST_CASE(a_highlight_that_may_jump_has_its_size_as_bound) {
  SceneData data;
  add_plane(data, {0, 0, 0}, {0, 0, 1}, {.specular = 0.5, .shininess = 0});
  add_directional_light(data, {-1, 0, -1});
  BOOST_TEST(bounded_radiance(Scene(data, Kernel::automatic), {1, 0, 1}, {-1, 0, -1}).bound >= 0.5);
  BOOST_TEST(bounded_radiance(Scene(data, Kernel::automatic), {0.9, 0, 1}, {-0.9, 0, -1}).bound < 1e-13);
}

// Within one mirror the error grows by its square at most, not as a product.
BOOST_AUTO_TEST_CASE(paths_within_one_mirror_stay_certified) {
  for (const std::uint32_t bounces : {10u, 100u, 1000u}) {
    SceneData data;
    Material wall = matte({0.5, 0.75, 1});
    wall.reflection = 0.99;
    add_sphere(data, {0, 0, 0}, 1, wall);
    add_directional_light(data, {0, 0, -1});
    add_point_light(data, {0.25, 0.5, -0.125});
    data.image.max_bounces = bounces;
    BoundCheck check(data);
    Random random(192);
    for (int i = 0; i != 20; ++i) check.trace(random.in_box(0.5), random.direction());
    check.report(std::to_string(bounces) + " bounces within a mirror");
    BOOST_TEST(check.certified >= 19);
    BOOST_TEST(check.largest < 1e-9);
  }
}

// Plane mirrors leave a line as far off as it was: roundings add up, and the way multiplies what they turned.
BOOST_AUTO_TEST_CASE(paths_between_plane_mirrors_stay_certified) {
  SceneData data;
  Material wall = matte({0.5, 0.75, 1});
  wall.reflection = 0.95;
  add_plane(data, {0, 3, 0}, {0, -1, 0}, wall);
  add_plane(data, {0, -3, 0}, {0.01, 1, 0}, wall);
  add_sphere(data, {4, 0, 1}, 0.25);
  add_point_light(data, {0.25, 0.5, -0.125});
  data.image.max_bounces = 60;
  BoundCheck check(data);
  Random random(194);
  for (int i = 0; i != 200; ++i) {
    check.trace(random.in_box(0.5), {random.uniform(-0.1, 0.1), 1, random.uniform(-0.3, 0.3)});
  }
  check.report("60 bounces between planes");
  BOOST_TEST(check.certified >= 198);
  BOOST_TEST(check.largest < 1e-10);
}

// Between two convex mirrors it grows as the product of 1 + 2 t / (r cos theta), here some 10 a bounce.
BOOST_AUTO_TEST_CASE(paths_between_convex_mirrors_are_given_up_in_time) {
  int certified = 0;
  for (const std::uint32_t bounces : {1u, 3u, 6u, 9u, 12u, 20u}) {
    SceneData data;
    Material ball = matte();
    ball.reflection = 0.9;
    add_sphere(data, {-3, 0, 0}, 1, ball);
    add_sphere(data, {3, 0, 0}, 1, ball);
    add_sphere(data, {0, 0, -103}, 100);
    add_point_light(data, {5, -7, 9});
    data.environment.background = {0.25, 0.5, 0.75};
    data.image.max_bounces = bounces;
    BoundCheck check(data);
    Random random(193);
    for (int i = 0; i != 300; ++i) {
      check.trace({0, 0, 0}, Vec3{-1, 0, 0} + random.over_decades(1e-17, 0.1) * random.direction());
    }
    check.report(std::to_string(bounces) + " bounces between mirrors");
    BOOST_TEST(check.certified > (bounces <= 9 ? 250 : 20));
    certified += check.certified;
  }
  BOOST_TEST(certified < 6 * 300);
}

BOOST_AUTO_TEST_CASE(cells_that_doubles_cannot_count_are_uncertified) {
  SceneData data;
  add_plane(data, {0, 0, 0}, {0, 0, 1});
  for (const double size : {1e-130, 1e-20}) {
    data.planes[0].checker = Checker{add_material(data, mirror()), size};
    BOOST_TEST(!is_certified(data, {0.5, 0.25, 1}, {0.3, 0.1, -1}), size);
  }
}

// The light is where the ray ends: nothing there is in its way, and nothing is rounded to be.
BOOST_AUTO_TEST_CASE(lights_exactly_on_surfaces_keep_the_bound) {
  SceneData data;
  add_sphere(data, {0, 0, 0}, 5);
  add_plane(data, {0, 0, -9}, {0, 0, 1});
  add_point_light(data, {3, 0, -4});
  SceneData on_a_plane;
  add_sphere(on_a_plane, {1, 2, 3}, 1);
  add_plane(on_a_plane, {0, 0, 0}, {1, 2, 3});
  add_point_light(on_a_plane, {3, 0, -1});
  add_point_light(on_a_plane, {2, -1, 0});
  BoundCheck on_sphere_check(data);
  BoundCheck on_plane_check(on_a_plane);
  Random random(195);
  for (int i = 0; i != 1000; ++i) {
    on_sphere_check.trace({8, 1, -8}, Vec3{4, 0, -9} + 2 * random.in_box(1) - Vec3{8, 1, -8});
    on_plane_check.trace({4, 4, 8}, Vec3{1, 2, 3} + random.in_box(0.9) - Vec3{4, 4, 8});
  }
  on_sphere_check.report("light on a sphere");
  on_plane_check.report("lights in a plane");
}

// A sphere of 1e-21 at a place of size 1: quad precision must not lose it either.
BOOST_AUTO_TEST_CASE(tiny_spheres_keep_the_bound) {
  SceneData data;
  const Vec3 center{0.93132257393562279, -0.93132257432169663, -6.5e-10};
  add_sphere(data, center, 1.65e-21, {.specular = 0.5, .shininess = 10});
  add_directional_light(data, {1, -2, -1});
  BoundCheck check(data);
  Random random(196);
  for (int i = 0; i != 300; ++i) {
    const Vec3 eye = center + 1e-19 * random.direction();
    check.trace(eye, center - eye);
  }
  check.report("tiny sphere");
}

// The second of two equal planes is never met, and casts no doubt.
BOOST_AUTO_TEST_CASE(planes_given_twice_stay_certified) {
  SceneData data;
  add_plane(data, {0, 0, 0}, {1, 2, 3}, mirror(0.5));
  add_plane(data, {0, 0, 0}, {1, 2, 3});
  add_point_light(data, {3, 1, 4});
  BOOST_TEST(is_certified(data, {1, 2, 4}, {0.25, -0.125, -1}));
}

// Nothing to normalise: the light is the shaded point, or straight behind a surface seen edge on.
BOOST_AUTO_TEST_CASE(lights_without_a_direction_raise_nothing) {
  SceneData data;
  add_sphere(data, {0, 0, 0}, 1, {.specular = 0.5});
  add_point_light(data, {0, 0, 1});
  BOOST_TEST(!is_certified(data, {0, 0, 3}, {0, 0, -1}));
  const Vec3 grazing{-0.22865650041166749, 0.2822955407712493, -0.93167882474603714};
  data.lights[0] = {LightKind::directional, -grazing, kWhite};
  data.image.shade = Shade::blinn;
  BOOST_TEST(!is_certified(data, {1.6561424461441809, -0.85994867161803445, 2.5529748295394428}, grazing));
}

BOOST_AUTO_TEST_SUITE_END()
