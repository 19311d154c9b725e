// SPDX-License-Identifier: BSD-3-Clause
// Distances, sizes and places of whole scenes.
#include "stress/stress_scene.h"

using namespace tessera::stress;

namespace {

/// Every length of a scene times `factor`.
SceneData times(SceneData data, double factor) {
  for (Sphere& sphere : data.spheres) sphere = {factor * sphere.center, factor * sphere.radius, sphere.material};
  for (Plane& plane : data.planes) plane.point = factor * plane.point;
  for (Light& light : data.lights) light.vector = factor * light.vector;
  data.camera->eye = factor * data.camera->eye;
  data.camera->target = factor * data.camera->target;
  return data;
}

SceneData moved(SceneData data, const Vec3& way) {
  for (Sphere& sphere : data.spheres) sphere.center = sphere.center + way;
  for (Plane& plane : data.planes) plane.point = plane.point + way;
  for (Light& light : data.lights) light.vector = light.vector + way;
  data.camera->eye = data.camera->eye + way;
  data.camera->target = data.camera->target + way;
  return data;
}

/// One shaded sphere of radius r, seen from 10 r.
SceneData lone_sphere(double r) {
  SceneData data;
  add_sphere(data, {}, r, {.specular = 0.5, .shininess = 10});
  add_point_light(data, {3 * r, -9 * r, 4 * r});
  data.camera = Camera{.eye = {0, -10 * r, 0}, .target = {}, .fov = 13};
  return data;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(scale_cases)

// Light at the eye: ambient + diffuse c + specular max(0, 2 c^2 - 1)^s with c the cosine at the hit.
BOOST_AUTO_TEST_CASE(case_01_spheres_at_any_distance) {
  Verdict verdict(1, "no wrong surface to the rim; error <= 1e-12 where l < 0.9 r");
  Random random(1);
  std::size_t wrong = 0;
  std::size_t tried = 0;
  double error = 0;
  for (int k = 0; k <= 12; ++k) {
    const double distance = k == 0 ? 1.001 : std::pow(10.0, k);
    SceneData data;
    add_sphere(data, {}, 1, {.specular = 0.5, .shininess = 8});
    const Vec3 away = random.direction();
    const Vec3 eye = distance * away;
    add_point_light(data, eye);
    const Scene scene(data, Kernel::automatic);
    HitCheck check(scene);
    for (int i = 0; i != 1000; ++i) {
      const double passing =
          i % 2 == 0 ? random.uniform(0, 0.88) : 1 + (random.flip() ? 1 : -1) * random.over_decades(1e-16, 0.1);
      const Vec3 direction = passing * random.perpendicular_to(away) - eye;
      check.trace(eye, direction);
      if (passing > 0.88) continue;
      const QuadVec exact = QuadTracer(scene.view(), eye, direction).radiance();
      error = std::max(error, error_of(seen_from(scene, eye, direction).r, exact.x));
    }
    wrong += check.wrong;
    tried += check.tried;
  }
  verdict.none_wrong("rays", wrong, tried);
  verdict.at_most("error", error, 1e-12);
}

BOOST_AUTO_TEST_CASE(case_02_radii_over_300_decades) {
  Verdict verdict(2, "picture within 1e-12; powers of two the same bits");
  const auto one = picture_of(lone_sphere(1));
  double error = 0;
  bool same = true;
  for (int k = -150; k <= 150; k += 10) {
    const auto other = picture_of(lone_sphere(std::pow(10.0, k)));
    error = std::max(error, largest_difference(one, other));
    same = same && largest_difference(one, picture_of(lone_sphere(std::ldexp(1.0, 3 * k)))) == 0;
  }
  verdict.at_most("error", error, 1e-12);
  verdict.require(same, "same bits");
}

BOOST_AUTO_TEST_CASE(case_03_scene_times_powers_of_two) {
  Verdict verdict(3, "same bits");
  const auto picture = picture_of(small_scene());
  for (const int k : {-300, -100, -10, -1, 1, 10, 100, 300}) {
    verdict.require(picture_of(times(small_scene(), std::ldexp(1.0, k))) == picture, "2^" + std::to_string(k));
  }
}

BOOST_AUTO_TEST_CASE(case_04_scene_mirrored) {
  Verdict verdict(4, "same bits after flipping");
  SceneData data = small_scene();
  const auto picture = picture_of(data);
  for (Sphere& sphere : data.spheres) sphere.center.x = -sphere.center.x;
  for (Light& light : data.lights) light.vector.x = -light.vector.x;
  data.camera->eye.x = -data.camera->eye.x;
  const auto mirrored = picture_of(data);
  std::size_t off = 0;
  for (std::size_t i = 0; i != picture.size(); ++i) off += !(picture[i] == mirrored[i / 32 * 32 + 31 - i % 32]);
  verdict.none_wrong("pixels differ", off, picture.size());
}

BOOST_AUTO_TEST_CASE(case_05_order_of_the_spheres) {
  Verdict verdict(5, "same bits");
  SceneData data = small_scene();
  const auto picture = picture_of(data);
  std::reverse(data.spheres.begin(), data.spheres.end());
  verdict.require(picture_of(data) == picture, "reversed");
  std::rotate(data.spheres.begin(), data.spheres.begin() + 5, data.spheres.end());
  verdict.require(picture_of(data) == picture, "rotated");
}

// All coordinates have 20 bits behind the point, so the shift rounds nothing, and the rays stay the same.
BOOST_AUTO_TEST_CASE(case_06_scene_moved) {
  Verdict verdict(6, "no wrong surface; within 1e-6 at 1e9");
  const auto picture = picture_of(small_scene());
  for (const double way : {1e3, 1e6, 1e9}) {
    const SceneData data = moved(small_scene(), {way, -way, way});
    if (way == 1e9) verdict.at_most("error at 1e9", largest_difference(picture_of(data), picture), 1e-6);
    const Scene scene = prepared(data);
    HitCheck check(scene);
    check.trace_picture(32);
    verdict.none_wrong("rays", check.wrong, check.tried);
  }
}

BOOST_AUTO_TEST_CASE(case_16_denormal_scenes) {
  Verdict verdict(16, "no crash; within 1e-12");
  const auto one = picture_of(lone_sphere(1));
  // Multiples of the smallest number: 2^-1060 has 14 bits to spare, enough for every length here.
  verdict.at_most("2^-1060:", largest_difference(picture_of(lone_sphere(0x1p-1060)), one), 1e-12);
  for (const double r : {1e-310, 3e-322}) {
    const SceneData data = lone_sphere(r);
    const Scene scene = prepared(data);
    HitCheck check(scene);
    check.trace_picture(32);
    verdict.none_wrong("rays", check.wrong, check.tried);
    verdict.at_most("normal", check.normal, 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(case_32_extreme_fields_of_view) {
  Verdict verdict(32, "no wrong surface");
  for (const double fov : {1e-9, 179.9}) {
    SceneData data = small_scene();
    data.camera->fov = fov;
    if (fov < 1) data.camera->target = data.spheres[3].center + Vec3{0, 0, data.spheres[3].radius};
    const Scene scene = prepared(data);
    HitCheck check(scene);
    check.trace_picture(64);
    verdict.none_wrong("rays", check.wrong, check.tried);
  }
}

BOOST_AUTO_TEST_SUITE_END()
