// SPDX-License-Identifier: BSD-3-Clause
// Hit or miss where a line touches or grazes a sphere.
#include "render/sphere.h"
#include "stress/stress_scene.h"

using namespace tessera::stress;

namespace {

std::optional<Crossing> entry(const Vec3& origin, const Vec3& direction, const Vec3& center, double radius) {
  return entry_into({.origin = origin, .direction = direction}, norm_of(direction), center, radius);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tangent_cases)

// y = 1 touches x^2 + y^2 = 1 at (0, 1).
BOOST_AUTO_TEST_CASE(case_07_tangent_ray_touches) {
  Verdict verdict(7, "t = 5, N = (0, 1, 0) exactly");
  const auto touch = entry({-5, 1, 0}, {1, 0, 0}, {}, 1);
  verdict.require(touch && touch->t.value == 5, "t = 5");
  verdict.require(touch && normal_at(*touch, {1, 0, 0}) == Vec3{0, 1, 0}, "N = (0, 1, 0)");
}

BOOST_AUTO_TEST_CASE(case_08_next_radii_miss_and_hit) {
  Verdict verdict(8, "next smaller radius misses, next larger hits");
  verdict.require(!entry({-5, 1, 0}, {1, 0, 0}, {}, std::nextafter(1, 0)), "misses");
  verdict.require(entry({-5, 1, 0}, {1, 0, 0}, {}, std::nextafter(1, 2)).has_value(), "hits");
}

// l / r = 1 - 10^-k: h^2 = r^2 - l^2.
BOOST_AUTO_TEST_CASE(case_10_grazing_half_chords) {
  Verdict verdict(10, "half chord within 20u (r/h)^2");
  Random random(10);
  double worst = 0;
  for (int k = 1; k <= 14; ++k) {
    for (int i = 0; i != 2000; ++i) {
      const double radius = random.over_decades(1e-3, 1e3);
      const Vec3 away = random.direction();
      const Vec3 center = radius * random.in_box(2);
      const Vec3 origin = center + random.over_decades(2, 1e3) * radius * away;
      const Vec3 direction = center + (1 - std::pow(10.0, -k)) * radius * random.perpendicular_to(away) - origin;
      const Ray ray{.origin = origin, .direction = direction};
      const DirectionNorm norm = norm_of(direction);
      const double s = half_chord(passage_of(ray, norm, center, radius)).value;
      const QuadLine exact(origin, direction, center, radius);
      if (!(exact.discriminant > 0) || !(s > 0)) continue;
      const Quad h = square_root(exact.discriminant);
      const double ratio = radius * norm.length / static_cast<double>(h);
      worst = std::max(worst, error_of(s, h) / static_cast<double>(h) / (kUnitRoundoff * ratio * ratio));
    }
  }
  verdict.at_most("error / u (r/h)^2:", worst, 20);
}

// 13^2 = 5^2 + 12^2.
BOOST_AUTO_TEST_CASE(case_11_hit_of_the_5_12_13_triangle) {
  Verdict verdict(11, "t = 88, N = (-12/13, 5/13, 0) to 1 ulp");
  const auto hit = entry({-100, 5, 0}, {1, 0, 0}, {}, 13);
  verdict.require(hit && hit->t.value == 88, "t = 88");
  const Vec3 n = hit ? normal_at(*hit, {1, 0, 0}) : Vec3{};
  verdict.at_most("N off by", std::max({std::abs(n.x + 12.0 / 13), std::abs(n.y - 5.0 / 13), std::abs(n.z)}), 0x1p-53);
}

BOOST_AUTO_TEST_CASE(case_12_length_of_the_direction) {
  Verdict verdict(12, "d x 2^k: same bits; length 1e+-200: same surface");
  const Scene scene = prepared(small_scene());
  Random random(12);
  std::size_t changed = 0;
  std::size_t lost = 0;
  std::size_t tried = 0;
  for (int i = 0; i != 2000; ++i) {
    const Vec3 eye = random.in_box(1);
    const Vec3 d = random.direction();
    const auto hit = hit_from(scene, eye, d);
    for (const int k : {-900, -300, -1, 1, 300, 900}) {
      const auto other = hit_from(scene, eye, std::ldexp(1.0, k) * d);
      changed += hit.has_value() != other.has_value() ||
                 (hit && (hit->surface != other->surface || hit->normal != other->normal ||
                          hit->t != std::ldexp(other->t, k)));
      ++tried;
    }
    for (const double size : {1e-200, 1e200}) {
      const auto other = hit_from(scene, eye, size * d);
      lost += hit.has_value() != other.has_value() || (hit && hit->surface != other->surface);
    }
  }
  verdict.none_wrong("hits changed", changed, tried);
  verdict.none_wrong("surfaces changed", lost, 4000);
}

// r = 1e-3 and 3e5, D/r = 3, 8e3, 2e5, above a floor sphere of 1e4 r.
BOOST_AUTO_TEST_CASE(case_44_small_sphere_on_a_huge_one) {
  Verdict verdict(44, "no wrong surface, normals to 1e-11");
  Random random(44);
  std::size_t wrong = 0;
  std::size_t tried = 0;
  double normal = 0;
  for (const double r : {1e-3, 3e5}) {
    for (const double distance : {3.0, 8e3, 2e5}) {
      SceneData data;
      add_sphere(data, {0, 0, r}, r);
      add_sphere(data, {0, 0, -1e4 * r}, 1e4 * r);
      const Scene scene = prepared(data);
      const double unit = scene.sphere(surface_id(0)).radius;
      HitCheck check(scene);
      for (int i = 0; i != 2000; ++i) {
        Vec3 away = random.direction();
        away.z = std::abs(away.z) + 0.01;
        const Vec3 eye = distance * unit * away + Vec3{0, 0, unit};
        check.trace(eye, 1.5 * unit * random.in_box(1) + Vec3{0, 0, unit} - eye);
      }
      wrong += check.wrong;
      tried += check.tried;
      normal = std::max(normal, check.normal);
    }
  }
  verdict.none_wrong("rays", wrong, tried);
  verdict.at_most("normal", normal, 1e-11);
}

BOOST_AUTO_TEST_SUITE_END()
