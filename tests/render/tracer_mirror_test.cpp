// SPDX-License-Identifier: BSD-3-Clause
// Mirrors: the mix of local and mirrored light, where paths end, and paths whose course has a closed form.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/random.h"
#include "render/scene_fixture.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr double u = 0x1p-53;

SceneData with_bounces(SceneData scene, std::uint32_t max_bounces) {
  scene.image.max_bounces = max_bounces;
  return scene;
}

/// Two facing mirrors on the x axis, at -1 and +1, of local light 0.25 and 1, k both: planes or spheres.
enum class Mirrors { planes, spheres };
SceneData facing_mirrors(Mirrors kind, double k) {
  SceneData scene;
  scene.environment.background = {0.5, 0.5, 0.5};
  for (const double x : {-1.0, 1.0}) {
    const Material material = glowing(x < 0 ? Rgb{0.25, 0.25, 0.25} : kWhite, k);
    if (kind == Mirrors::planes) add_plane(scene, {x, 0, 0}, {1, 0, 0}, material);
    if (kind == Mirrors::spheres) add_sphere(scene, {3 * x, 0, 0}, 2, material);
  }
  return scene;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tracer_mirror)

// (1 - k) local + k mirrored, the mirror ray going back into the background.
BOOST_AUTO_TEST_CASE(mirror_mixes_local_and_mirrored_light) {
  SceneData scene;
  scene.environment.background = {0, 8, 16};
  add_sphere(scene, {0, 0, 0}, 1, glowing({4, 4, 0}, 0.25));
  BOOST_TEST((seen_from(scene, {-9, 0, 0}, {1, 0, 0}) == Rgb{3, 5, 4}));
}

// A plane at 45 degrees turns the ray from x to z, where a sphere shines; its back does the same.
BOOST_AUTO_TEST_CASE(mirror_ray_leaves_at_the_angle_of_incidence) {
  SceneData scene;
  add_plane(scene, {0, 0, 0}, {-1, 0, 1}, mirror());
  add_sphere(scene, {0, 0, 5}, 1e-3, glowing({0, 1, 0}));
  add_sphere(scene, {0, 0, -5}, 1e-3, glowing({0, 0, 1}));
  BOOST_TEST((seen_from(scene, {-9, 0, 0}, {1, 0, 0}) == Rgb{0, 1, 0}));
  BOOST_TEST((seen_from(scene, {9, 0, 0}, {-2, 0, 0}) == Rgb{0, 0, 1}));
}

// n mirror rays, then the background in the place of the next.
BOOST_AUTO_TEST_CASE(path_cut_by_the_bounce_limit_sees_the_background) {
  SceneData scene = facing_mirrors(Mirrors::planes, 0.5);
  const auto seen = [&](std::uint32_t n) { return seen_from(with_bounces(scene, n), {0, 0, 0}, {1, 0, 0}).g; };
  BOOST_TEST(seen(0) == 0.5 * 1 + 0.5 * 0.5);
  BOOST_TEST(seen(1) == 0.5 * 1 + 0.5 * (0.5 * 0.25 + 0.5 * 0.5));
  BOOST_TEST(seen(2) == 0.5 * 1 + 0.5 * (0.5 * 0.25 + 0.5 * (0.5 * 1 + 0.5 * 0.5)));
}

// Exactly axial: (1 - k) Sum k^i L_i + k^(n+1) background, with the limit (L1 + k L2) / (1 + k).
BOOST_AUTO_TEST_CASE(facing_mirrors_sum_a_geometric_series) {
  for (const Mirrors kind : {Mirrors::planes, Mirrors::spheres}) {
    for (const double k : {0.0, 0.1, 0.5, 0.9, 0.999, 1.0}) {
      for (const std::uint32_t n : {0U, 1U, 2U, 3U, 10U, 99U, 1000U}) {
        const long double q = k;
        const std::uint32_t ones = n / 2 + 1;
        const std::uint32_t quarters = (n + 1) / 2;
        // (1 - q) (1 + q^2 + ... ) = (1 - q^(2 m)) / (1 + q)
        const long double series =
            ((1 - std::pow(q, 2 * ones)) + 0.25L * q * (1 - std::pow(q, 2 * quarters))) / (1 + q);
        const long double expected = series + std::pow(q, n + 1) * 0.5L;
        const Rgb seen = seen_from(with_bounces(facing_mirrors(kind, k), n), {0, 0, 0}, {1, 0, 0});
        BOOST_TEST(std::abs(static_cast<double>(seen.r - expected)) <= (n + 1) * 4 * u, "k " << k << " n " << n);
      }
    }
  }
  const double limit = (1 + 0.5 * 0.25) / 1.5;
  const Rgb seen = seen_from(with_bounces(facing_mirrors(Mirrors::planes, 0.5), 1000), {0, 0, 0}, {1, 0, 0});
  BOOST_TEST(std::abs(seen.r - limit) <= 4 * u);
}

// Inside a closed mirror sphere of local light a, wherever one looks: a (1 - k^n) + k^n b, n = max_bounces + 1.
BOOST_AUTO_TEST_CASE(furnace_is_the_same_in_every_direction) {
  Random random(151);
  double worst = 0;
  for (const double k : {0.0, 0.3, 0.9, 0.999, 1.0}) {
    for (const std::uint32_t bounces : {0U, 1U, 5U, 100U, 2000U}) {
      SceneData data;
      data.environment.background = {3, 3, 3};
      data.image.max_bounces = bounces;
      add_sphere(data, {1, 2, 3}, 4, glowing({0.7, 0.7, 0.7}, k));
      const Scene scene(data, Kernel::automatic);
      const double kn = std::pow(k, bounces + 1.0);
      for (int i = 0; i != 20; ++i) {
        const Rgb seen = seen_from(scene, Vec3{1, 2, 3} + random.in_box(2), random.direction());
        worst = std::max(worst, std::abs(seen.g - (0.7 * (1 - kn) + kn * 3)));
      }
    }
  }
  BOOST_TEST_MESSAGE("furnace: " << worst);
  BOOST_TEST(worst <= 1e-13);
}

// k^n is below the smallest double after 7073 bounces of k = 0.9: the path ends there, whatever the limit.
BOOST_AUTO_TEST_CASE(path_ends_when_its_weight_reaches_zero) {
  for (const double k : {0.1, 0.5, 0.9}) {
    SceneData data;
    data.image.max_bounces = 200'000;
    add_sphere(data, {0, 0, 0}, 4, glowing(kWhite, k));
    RayCounts counts;
    const Rgb seen = seen_from(Scene(data, Kernel::automatic), {1, 2, 0}, {1, 0, 0.5}, counts);
    BOOST_TEST(std::abs(seen.r - 1) <= 1e-13);
    BOOST_TEST(counts.mirror <= 10'000U, "k " << k << ": " << counts.mirror << " mirror rays");
  }
}

BOOST_AUTO_TEST_CASE(surface_without_reflection_sends_no_mirror_ray) {
  SceneData data = with_bounces(facing_mirrors(Mirrors::planes, 0), 2147483647);
  RayCounts counts;
  seen_from(Scene(data, Kernel::automatic), {0, 0, 0}, {1, 0, 0}, counts);
  BOOST_TEST(counts.primary == 1U);
  BOOST_TEST(counts.mirror == 0U);
}

// Eye and object at distance e from a mirror ball, symmetric at angle theta: the image is seen at
// atan(e sin theta / (e cos theta - r)) from the axis of symmetry.
BOOST_AUTO_TEST_CASE(symmetric_image_in_a_mirror_ball_is_where_alhazen_says) {
  for (const double e : {1.1, 2.0, 30.0}) {
    for (const double theta : {0.1, 0.3, 0.4}) {
      SceneData data;
      add_sphere(data, {0, 0, 0}, 1, mirror());
      const Vec3 eye{-e * std::sin(theta), 0, e * std::cos(theta)};
      add_sphere(data, {-eye.x, 0, eye.z}, 1e-12 * e, glowing({0, 1, 0}));
      const Scene scene(data, Kernel::automatic);
      const auto shown_at = [&](double angle) {
        return seen_from(scene, eye, {std::sin(angle), 0, -std::cos(angle)}) == Rgb{0, 1, 0};
      };
      const double image = std::atan(e * std::sin(theta) / (e * std::cos(theta) - 1));
      BOOST_TEST(shown_at(image));
      BOOST_TEST(!shown_at(image + 1e-11));
      BOOST_TEST(!shown_at(image - 1e-11));
    }
  }
}

// In a mirror ball a regular polygon closes: after n bounces the ray comes back along its first edge and meets the
// small sphere behind its start, not earlier.
BOOST_AUTO_TEST_CASE(regular_polygons_in_a_mirror_ball_close) {
  Random random(152);
  for (const auto& [corners, turns] : {std::pair{3, 1}, {4, 1}, {5, 1}, {5, 2}, {6, 1}, {7, 3}, {12, 5}, {100, 33}}) {
    const Vec3 x = random.direction();
    const Vec3 y = normalized(random.perpendicular_to(x));
    const double apothem = std::cos(kPi * turns / corners);
    SceneData data;
    data.image.max_bounces = static_cast<std::uint32_t>(corners);
    add_sphere(data, {0, 0, 0}, 1, mirror());
    add_sphere(data, apothem * x - 0.01 * y, 1e-12 * corners, glowing({0, 1, 0}));
    BOOST_TEST((seen_from(data, apothem * x, y) == Rgb{0, 1, 0}), corners << " corners");
    data.image.max_bounces -= 1;
    BOOST_TEST((seen_from(data, apothem * x, y) == Rgb{}), corners << " corners");
  }
}

// Two coincident mirror spheres around the eye: all bounces belong to the first, so the furnace shows its light alone.
BOOST_AUTO_TEST_CASE(coincident_mirrors_around_the_eye_show_the_first_at_every_bounce) {
  Random random(153);
  for (const bool reversed : {false, true}) {
    int wrong = 0;
    for (int i = 0; i != 200; ++i) {
      SceneData data;
      const Vec3 center = random.in_box(3);
      add_sphere(data, center, 1.7, glowing(reversed ? kWhite : Rgb{}, 0.9));
      add_sphere(data, center, 1.7, glowing(reversed ? Rgb{} : kWhite, 0.9));
      data.image.max_bounces = 20;
      const double expected = reversed ? 1 - std::pow(0.9, 21) : 0;
      wrong += std::abs(seen_from(data, center + random.in_box(0.9), random.direction()).g - expected) > 1e-13;
    }
    BOOST_TEST(wrong == 0, wrong << " of 200 paths saw the second sphere");
  }
}

// A mirror sphere on a floor, touching it: the mirror ray from near the contact sees the floor, not through it.
BOOST_AUTO_TEST_CASE(mirror_touching_a_floor_shows_its_near_side) {
  SceneData data;
  data.environment.background = {1, 0, 0};
  add_sphere(data, {0, 0, 1}, 1, mirror());
  add_plane(data, {0, 0, 0}, {0, 0, 1}, glowing({0, 1, 0}));
  const Scene scene(data, Kernel::automatic);
  int wrong = 0;
  for (double height = 1e-12; height < 0.5; height *= 1.5) {
    wrong +=
        seen_from(scene, {-9, 0, 0.25}, Vec3{-std::sqrt(2 * height), 0, height} - Vec3{-9, 0, 0.25}) != Rgb{0, 1, 0};
  }
  BOOST_TEST(wrong == 0);
}

BOOST_AUTO_TEST_SUITE_END()
