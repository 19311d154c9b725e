// SPDX-License-Identifier: BSD-3-Clause
// Lights, mirrors and their closed forms.
#include "stress/stress_scene.h"

using namespace tessera::stress;

BOOST_AUTO_TEST_SUITE(shading_cases)

BOOST_AUTO_TEST_CASE(case_26_light_inside_a_sphere) {
  Verdict verdict(26, "exactly ambient");
  SceneData data;
  const Material material{.color = {1, 1, 1}, .ambient = 0.125, .diffuse = 1, .specular = 1};
  add_sphere(data, {}, 1, material);
  add_sphere(data, {4, 0, 0}, 1, material);
  add_point_light(data, {0.25, 0, 0});
  Random random(26);
  std::size_t off = 0;
  std::size_t hits = 0;
  for (int i = 0; i != 2000; ++i) {
    const Vec3 eye = 10 * random.direction();
    const Vec3 direction = Vec3{random.flip() ? 4.0 : 0.0, 0, 0} + random.in_box(0.9) - eye;
    const Scene scene = prepared(data);
    const double unit = scene.sphere(surface_id(0)).radius;
    if (!hit_from(scene, unit * eye, direction)) continue;
    ++hits;
    off += !(seen_from(scene, unit * eye, direction) == Rgb{0.125, 0.125, 0.125});
  }
  verdict.none_wrong("pixels lit", off, hits);
}

// A light on the sphere at (0, 0, 1): every point of it lies below the tangent plane there, N.L <= 0 or hidden.
BOOST_AUTO_TEST_CASE(case_28_light_on_a_surface_and_at_the_point) {
  Verdict verdict(28, "no self-shadow; term 0, no NaN");
  SceneData data;
  add_sphere(data, {0, 0, 0}, 5, {.color = {1, 1, 1}, .ambient = 0.25, .diffuse = 1, .specular = 1, .shininess = 0});
  add_point_light(data, {3, 0, 4});
  const Scene scene(data, Kernel::automatic);
  // Straight at the light: the shaded point is the light.
  verdict.require(seen_from(scene, {6, 0, 8}, {-3, 0, -4}) == Rgb{0.25, 0.25, 0.25}, "at the light: ambient");
  // A floor that the sphere stands on sees the light past the sphere that carries it.
  add_plane(data, {0, 0, 12}, {0, 0, -1}, matte());
  const Scene roof(data, Kernel::automatic);
  const double seen = seen_from(roof, {3, 0, 11}, {0, 0, 1}).r;
  verdict.at_most("roof off by", std::abs(seen - 1), 1e-15);
  // Inside: the whole wall sees a light on it.
  const double wall = seen_from(roof, {0, 0, 0}, {-3, 0, -4}).r;
  verdict.require(wall > 1, "wall opposite is lit");
}

// radiance = (1 - k) sum k^i L_i + k^(n+1) background, L_i alternating.
BOOST_AUTO_TEST_CASE(case_33_facing_mirrors) {
  Verdict verdict(33, "closed form within (n + 1) 4u");
  double worst = 0;
  for (const double k : {0.0, 0.1, 0.5, 0.9, 0.999, 1.0}) {
    for (const std::uint32_t n : {0u, 1u, 2u, 5u, 17u, 100u, 1000u}) {
      SceneData data;
      add_sphere(data, {10, 0, 0}, 5, glowing({0.25, 0, 0}, k));
      add_sphere(data, {-10, 0, 0}, 5, glowing({1, 0, 0}, k));
      data.environment.background = {0.5, 0, 0};
      data.image.max_bounces = n;
      Quad weight = 1;
      Quad exact = 0;
      for (std::uint32_t i = 0; i <= n; ++i) {
        exact += weight * (1 - Quad(k)) * (i % 2 == 0 ? 0.25 : 1.0);
        weight *= k;
      }
      exact += weight * 0.5;
      const double seen = seen_from(prepared(data), {}, {1, 0, 0}).r;
      worst = std::max(worst, error_of(seen, exact) / ((n + 1) * 4 * kUnitRoundoff));
    }
  }
  verdict.at_most("error / (n + 1) 4u:", worst, 1);
}

// a (1 - k^(n+1)) + k^(n+1) b in a closed mirror.
BOOST_AUTO_TEST_CASE(case_35_furnace) {
  Verdict verdict(35, "a (1 - k^m) + k^m b within 1e-13, m = n + 1");
  Random random(35);
  double worst = 0;
  for (const double k : {0.0, 0.3, 0.9, 1.0}) {
    for (const std::uint32_t n : {0u, 1u, 4u, 50u}) {
      SceneData data;
      add_sphere(data, {}, 2, glowing({0.75, 0, 0}, k));
      data.environment.background = {0.125, 0, 0};
      data.image.max_bounces = n;
      const double rest = std::pow(k, n + 1);
      const Scene scene(data, Kernel::automatic);
      for (int i = 0; i != 50; ++i) {
        const double seen = seen_from(scene, random.in_box(1), random.direction()).r;
        worst = std::max(worst, std::abs(seen - (0.75 * (1 - rest) + rest * 0.125)));
      }
    }
  }
  verdict.at_most("error", worst, 1e-13);
}

// 0.9^n leaves the normal numbers at n = 6,723.
BOOST_AUTO_TEST_CASE(case_36_bounce_limits) {
  Verdict verdict(36, "iterative, ends when the weight is gone");
  SceneData data;
  add_sphere(data, {}, 2, glowing({0.75, 0, 0}, 0.9));
  data.environment.background = {0.125, 0, 0};
  for (const std::uint32_t n : {0u, 1u, 0x7fffffffu}) {
    data.image.max_bounces = n;
    RayCounts counts;
    seen_from(Scene(data, Kernel::automatic), {0.5, 0, 0}, {0.5, 1, 0.25}, counts);
    const std::uint64_t mirrors = n <= 1 ? n : 6723;
    verdict.require(counts.mirror <= mirrors && counts.mirror + 4 > mirrors,
                    std::to_string(counts.mirror) + " bounces");
  }
}

BOOST_AUTO_TEST_CASE(case_39_none_and_many) {
  Verdict verdict(39, "background; ambient; 2.0 within 1e-12");
  SceneData data;
  data.environment.background = {0.25, 0.5, 0.75};
  verdict.require(seen_from(data, {}, {1, 0, 0}) == Rgb{0.25, 0.5, 0.75}, "no spheres: background");
  add_sphere(data, {3, 0, 0}, 1, {.color = {1, 1, 1}, .ambient = 0.125, .diffuse = 1, .specular = 1});
  verdict.require(seen_from(data, {}, {1, 0, 0}) == Rgb{0.125, 0.125, 0.125}, "no lights: ambient");
  data.materials[0] = matte();
  for (int i = 0; i != 10000; ++i) add_directional_light(data, {1, 0, 0}, {0.0002, 0.0002, 0.0002});
  verdict.at_most("10,000 lights off by", std::abs(seen_from(data, {}, {1, 0, 0}).r - 2), 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
