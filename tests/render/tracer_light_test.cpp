// SPDX-License-Identifier: BSD-3-Clause
// Pictures and shadows whose value has a closed form.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/random.h"
#include "render/scene_fixture.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

using Real = long double;

/// Impact parameter of a ray's line: |f x d| / |d|.
Real impact_parameter(const Ray& ray, const Vec3& center) {
  const Real fx = Real(center.x) - ray.origin.x;
  const Real fy = Real(center.y) - ray.origin.y;
  const Real fz = Real(center.z) - ray.origin.z;
  const Vec3& d = ray.direction;
  const Real wx = fy * d.z - fz * d.y;
  const Real wy = fz * d.x - fx * d.z;
  const Real wz = fx * d.y - fy * d.x;
  return std::sqrt((wx * wx + wy * wy + wz * wz) / (Real(d.x) * d.x + Real(d.y) * d.y + Real(d.z) * d.z));
}

/// The largest angle from the z axis at which is_lit is false, by bisection between two angles.
template <class IsLit>
double shadow_edge(double dark, double lit, IsLit is_lit) {
  BOOST_REQUIRE((!is_lit(dark) && is_lit(lit)));
  for (int step = 0; step != 60; ++step) {
    const double middle = 0.5 * (dark + lit);
    (is_lit(middle) ? lit : dark) = middle;
  }
  return dark;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tracer_light)

// Light at the eye: L = V, so c = N.L = sqrt(1 - b^2 / r^2), R.V = 2 c^2 - 1, and every pixel is
// ambient + diffuse c + specular max(0, 2 c^2 - 1)^s.
BOOST_AUTO_TEST_CASE(light_at_the_eye_shades_every_pixel_by_its_impact_parameter) {
  for (const double distance : {1.5, 4.0, 1e2, 1e4}) {
    SceneData data;
    const Vec3 center{0.5, -0.25, 2};
    const Material material{.color = {0.5, 1, 2}, .ambient = 0.25, .diffuse = 0.5, .specular = 0.75, .shininess = 7};
    add_sphere(data, center, 1, material);
    const Vec3 eye = center + distance * normalized({1, 2, -2});
    add_point_light(data, eye);
    data.camera = Camera{.eye = eye, .target = center, .fov = 2.1 * std::asin(1 / distance) * 180 / kPi};
    const Scene scene(data, Kernel::automatic);
    const CameraRays rays(*data.camera, 48, 48);
    double worst = 0;
    int hits = 0;
    for (int pixel = 0; pixel != 48 * 48; ++pixel) {
      const Ray ray = rays.through(pixel % 48 + 0.5, pixel / 48 + 0.5);
      const Real b = impact_parameter(ray, center);
      const Rgb seen = seen_from(scene, eye, ray.direction);
      if (b > 1) {
        BOOST_REQUIRE((seen == Rgb{}));
        continue;
      }
      const Real c = std::sqrt(1 - b * b);
      const Real highlight = 0.75L * std::pow(std::max(0.0L, 2 * c * c - 1), 7.0L);
      const Real channels[] = {seen.r - (0.5L * (0.25L + 0.5L * c) + highlight),
                               seen.g - (0.25L + 0.5L * c + highlight), seen.b - (2 * (0.25L + 0.5L * c) + highlight)};
      for (const Real error : channels) worst = std::max(worst, static_cast<double>(std::abs(error)));
      ++hits;
    }
    BOOST_TEST_MESSAGE("light at the eye, D/r " << distance << ": " << worst);
    BOOST_TEST(hits > 1000);
    BOOST_TEST(worst <= 1e-13);
  }
}

// On the plane z = 1 a sphere at angle theta, sin alpha = r / D, covers an ellipse of area
// pi sin^2 alpha cos alpha / (cos^2 theta - sin^2 alpha)^(3/2).
BOOST_AUTO_TEST_CASE(silhouette_covers_the_area_of_its_ellipse) {
  constexpr int kSide = 1200;
  for (const double theta : {0.05, 0.3, 0.6}) {
    SceneData data;
    const double alpha = 0.25;
    add_sphere(data, 4.0 * Vec3{std::sin(theta), 0, std::cos(theta)}, 4 * std::sin(alpha));
    const Scene scene(data, Kernel::automatic);
    const CameraRays rays({.eye = {0, 0, 0}, .target = {0, 0, 1}, .up = {0, 1, 0}, .fov = 100}, kSide, kSide);
    int covered = 0;
    for (int pixel = 0; pixel != kSide * kSide; ++pixel) {
      const Ray ray = rays.through(pixel % kSide + 0.5, pixel / kSide + 0.5);
      covered += nearest_hit(scene, ray, region_at(scene, ray.origin, ray.direction)).has_value();
    }
    const double s2 = std::sin(alpha) * std::sin(alpha);
    const double area = kPi * s2 * std::cos(alpha) / std::pow(std::cos(theta) * std::cos(theta) - s2, 1.5);
    const double pixel_side = 2 * std::tan(kPi * 50 / 180) / kSide;
    const double counted = covered * pixel_side * pixel_side;
    BOOST_TEST_MESSAGE("silhouette at " << theta << ": " << counted / area - 1);
    BOOST_TEST(std::abs(counted / area - 1) <= 5e-4);
  }
}

// Light, blocker of radius r1 at distance D1 and a wall on one axis: the shadow's half angle is asin(r1 / D1).
BOOST_AUTO_TEST_CASE(coaxial_shadow_ends_at_the_tangent_cone) {
  for (const double ratio : {0.9, 0.5, 1e-1, 1e-3, 1e-6}) {
    SceneData data;
    add_sphere(data, {0, 0, 4}, 4 * ratio);
    add_plane(data, {0, 0, 32}, {0, 0, -1});
    add_point_light(data, {0, 0, 0});
    const Scene scene(data, Kernel::automatic);
    const double expected = std::asin(ratio);
    const double edge = shadow_edge(0.9 * expected, 1.1 * expected, [&](double angle) {
      const Vec3 at{32 * std::tan(angle), 0, 32};
      return seen_from(scene, at - Vec3{0, 0, 1}, {0, 0, 1}).r > 0;
    });
    BOOST_TEST_MESSAGE("coaxial shadow, r/D " << ratio << ": " << edge - expected);
    BOOST_TEST(std::abs(edge - expected) <= 4e-16 / std::cos(expected));
  }
}

// The same inside a hollow sphere around light and eye, whose wall catches the shadow: asin(q / D1).
BOOST_AUTO_TEST_CASE(shadow_on_the_wall_of_a_hollow_sphere_ends_at_the_tangent_cone) {
  for (const double q : {1.5, 0.5, 1e-3}) {
    SceneData data;
    add_sphere(data, {0, 0, 0}, 10);
    add_sphere(data, {0, 0, 2}, q);
    add_point_light(data, {0, 0, 0});
    const Scene scene(data, Kernel::automatic);
    const double expected = std::asin(q / 2);
    const double edge = shadow_edge(0.5 * expected, 1.5 * expected, [&](double angle) {
      const Vec3 on_wall{10 * std::sin(angle), 0, 10 * std::cos(angle)};
      const Vec3 eye{0, 9, 0};
      return seen_from(scene, eye, on_wall - eye).r > 0;
    });
    BOOST_TEST_MESSAGE("shadow in a hollow sphere, q " << q << ": " << edge - expected);
    BOOST_TEST(std::abs(edge - expected) <= 2e-15 / std::cos(expected));
  }
}

// From a point on the inner side of a sphere the far wall is at t = 2 r |N.d|.
BOOST_AUTO_TEST_CASE(own_chord_follows_the_cosine) {
  SceneData data;
  add_sphere(data, {1, 2, 3}, 5);
  const Scene scene(data, Kernel::automatic);
  const Region inside = region_at(scene, {1, 2, 3}, {1, 0, 0});
  Random random(131);
  double worst = 0;
  for (int i = 0; i != 5000; ++i) {
    const Vec3 normal = random.direction();
    Vec3 direction = random.direction();
    if (dot(normal, direction) > 0) direction = -direction;
    const Ray ray{Vec3{1, 2, 3} + 5 * normal, direction, surface_id(0), normal};
    const auto hit = nearest_hit(scene, ray, inside);
    BOOST_REQUIRE(hit.has_value());
    const double chord = -10 * dot(normal, direction) / dot(direction, direction);
    worst = std::max(worst, std::abs(hit->t - chord));
    worst = std::max(worst, length(hit->point - (ray.origin + hit->t * direction)));
  }
  BOOST_TEST_MESSAGE("own chord: " << worst);
  BOOST_TEST(worst <= 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
