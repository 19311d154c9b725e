// SPDX-License-Identifier: BSD-3-Clause
// Eyes on, in and just above surfaces; surfaces that touch, nest and coincide.
#include "stress/stress_scene.h"

using namespace tessera::stress;

BOOST_AUTO_TEST_SUITE(place_cases)

BOOST_AUTO_TEST_CASE(case_14_radius_zero_is_never_hit) {
  Verdict verdict(14, "never hit");
  SceneData data;
  add_sphere(data, {1, 0, 0}, 0);
  add_sphere(data, {3, 0, 0}, 1);
  for (const Kernel kernel : {Kernel::automatic, Kernel::brute}) {
    const Scene scene = prepared(data, kernel);
    const auto hit = hit_from(scene, {}, {1, 0, 0});
    verdict.require(hit && index_of(hit->surface) == 1, "the sphere behind is seen");
  }
}

// On a sphere of radius 5 at (3, 4, 0): outward nothing, inward the far wall at 2 r |N.d|, along it nothing.
BOOST_AUTO_TEST_CASE(case_17_eye_on_a_surface) {
  Verdict verdict(17, "own sphere unseen; far wall at 2r N.d; background");
  SceneData data;
  add_sphere(data, {}, 5);
  const Scene scene(data, Kernel::automatic);
  verdict.require(!hit_from(scene, {3, 4, 0}, {3, 4, 0.5}), "outward: background");
  verdict.require(!hit_from(scene, {3, 4, 0}, {-4, 3, 0}), "along: background");
  const auto wall = hit_from(scene, {3, 4, 0}, {-1, 0, 0});
  verdict.require(wall && wall->t == 6, "inward: t = 2 5 3/5");
}

BOOST_AUTO_TEST_CASE(case_18_eye_inside_off_centre) {
  Verdict verdict(18, "far wall everywhere");
  SceneData data;
  add_sphere(data, {1, 2, 3}, 2);
  const Scene scene = prepared(data);
  const double unit = scene.sphere(surface_id(0)).radius / 2;
  HitCheck check(scene);
  Random random(18);
  for (int i = 0; i != 20000; ++i) {
    const Vec3 offset = 2 * (1 - random.over_decades(1e-15, 1)) * random.direction();
    check.trace(scene.sphere(surface_id(0)).center + unit * offset, random.direction());
  }
  verdict.none_wrong("rays", check.wrong, check.tried);
  verdict.require(check.hits == check.tried, "a wall in every direction");
}

// The distance of the eye as rounded is what quad precision is given too.
BOOST_AUTO_TEST_CASE(case_19_eye_just_above_a_surface) {
  Verdict verdict(19, "t within 1e-12");
  Random random(19);
  std::size_t wrong = 0;
  std::size_t tried = 0;
  double t = 0;
  for (const double r : {1.0, 1e3, 1e6, 1e9, 1e12}) {
    SceneData data;
    add_sphere(data, {}, r);
    const Scene scene(data, Kernel::automatic);
    HitCheck check(scene);
    for (int k = 3; k <= 15; ++k) {
      for (int i = 0; i != 100; ++i) {
        const Vec3 up = random.direction();
        const Vec3 eye = r * (1 + std::pow(10.0, -k)) * up;
        if (!(length(eye) > r * (1 + 1e-15))) continue;
        check.trace(eye, 0.3 * random.direction() - up);
      }
    }
    wrong += check.wrong;
    tried += check.tried;
    t = std::max(t, check.t);
  }
  verdict.none_wrong("rays", wrong, tried);
  verdict.at_most("t", t, 1e-12);
}

// x = 0 separates the two: rays through the contact at the origin and near it.
BOOST_AUTO_TEST_CASE(case_20_view_and_light_through_a_contact) {
  Verdict verdict(20, "no wrong surface, no leak, no acne");
  SceneData data;
  add_sphere(data, {-1, 0, 0}, 1);
  add_sphere(data, {1, 0, 0}, 1);
  add_point_light(data, {0, -5, 0});
  data.image.max_bounces = 0;
  const Scene scene = prepared(data);
  HitCheck check(scene);
  Random random(20);
  std::size_t off = 0;
  std::size_t through = 0;
  for (int i = 0; i != 20000; ++i) {
    const double blur = i == 0 ? 0 : random.over_decades(1e-17, 1e-1);
    const Vec3 eye{0, 0.5, random.uniform(-0.1, 0.1)};
    const Vec3 direction = blur * random.in_box(0.1) - eye;
    check.trace(eye, direction);
    const double exact = static_cast<double>(QuadTracer(scene.view(), eye, direction).radiance().x);
    off += std::abs(seen_from(scene, eye, direction).r - exact) > 1e-6;
    through += !hit_from(scene, eye, direction);
  }
  verdict.none_wrong("surfaces", check.wrong, check.tried);
  verdict.none_wrong("radiances off", off, check.tried);
  verdict.require(through > 0 && through < check.tried, "some pass, some do not");
}

// A mirror of radius 1 at the origin and a neighbour beyond a gap of 10^-k, seen by its front through the mirror.
BOOST_AUTO_TEST_CASE(case_21_mirror_shows_the_front_of_its_neighbour) {
  Verdict verdict(21, "the neighbour's front, never its back wall");
  Random random(21);
  std::size_t wrong = 0;
  std::size_t tried = 0;
  for (int k = 1; k <= 15; ++k) {
    SceneData data;
    add_sphere(data, {}, 1, mirror());
    add_sphere(data, {2 + std::pow(10.0, -k), 0, 0}, 1, glowing({1, 0, 0}));
    const Scene scene(data, Kernel::automatic);
    const Region region = region_at(scene, {1, 5, 0}, {0, -1, 0});
    for (int i = 0; i != 500; ++i) {
      // From a point of the mirror that faces the neighbour, into its half space.
      const double angle = random.over_decades(1e-9, 0.3);
      const double turn = random.uniform(0, 2 * kPi);
      const Vec3 n{std::cos(angle), std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn)};
      const Vec3 unit = normalized(n);
      const auto hit =
          nearest_hit(scene, {unit, Vec3{1, 0, 0} + 0.2 * random.direction(), surface_id(0), unit}, region);
      ++tried;
      wrong += !hit || index_of(hit->surface) != 1 || hit->normal.x > 0;
    }
  }
  verdict.none_wrong("reflections", wrong, tried);
}

BOOST_AUTO_TEST_CASE(case_24_of_coincident_spheres_the_first_is_seen) {
  Verdict verdict(24, "lowest index, for every tree and from both sides");
  Random random(24);
  std::size_t wrong = 0;
  std::size_t tried = 0;
  for (int scene_number = 0; scene_number != 20; ++scene_number) {
    SceneData data;
    for (int i = 0; i != 40; ++i) add_sphere(data, random.in_box(2), random.uniform(0.1, 0.3));
    for (int i = 0; i != 40; ++i) data.spheres.push_back(data.spheres[static_cast<std::size_t>(i)]);
    for (const Kernel kernel : {Kernel::automatic, Kernel::brute}) {
      const Scene scene = prepared(data, kernel);
      for (int i = 0; i != 200; ++i) {
        const Sphere& aim = scene.sphere(surface_id(random.below(80)));
        const bool inside = random.flip();
        const Vec3 eye = inside ? aim.center : 4 * random.direction();
        const auto hit = hit_from(scene, eye, inside ? random.direction() : aim.center - eye);
        if (!hit) continue;
        ++tried;
        wrong += index_of(hit->surface) >= 40;
      }
    }
  }
  verdict.none_wrong("rays", wrong, tried);
}

BOOST_AUTO_TEST_CASE(case_25_ten_spheres_deep_in_overlap) {
  Verdict verdict(25, "no wrong surface");
  SceneData data;
  Random random(25);
  for (int i = 0; i != 10; ++i) add_sphere(data, random.in_box(0.3), random.uniform(0.8, 1));
  const Scene scene = prepared(data);
  HitCheck check(scene);
  for (int i = 0; i != 20000; ++i) {
    const Vec3 eye = random.in_box(i % 2 == 0 ? 0.4 : 3);
    check.trace(eye, i % 2 == 0 ? random.direction() : random.in_box(1) - eye);
  }
  verdict.none_wrong("rays", check.wrong, check.tried);
}

BOOST_AUTO_TEST_SUITE_END()
