// SPDX-License-Identifier: BSD-3-Clause
// The order of hits that double precision cannot tell apart, against roots of 4,000 bits.
#include "render/order.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/plane.h"
#include "render/random.h"
#include "render/rational.h"
#include "render/scene_fixture.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr mp_bitcnt_t kBits = 4000;

mpf_class real(const mpq_class& q) {
  return mpf_class(q, kBits);
}

/// The distance of a candidate, counted from 0 on.
mpf_class distance(const Scene& scene, const Ray& ray, const Candidate& candidate) {
  const RationalVec d(ray.direction);
  const mpq_class a = rational_dot(d, d);
  mpf_class t(0, kBits);
  if (candidate.meeting == Meeting::plane) {
    const Plane& plane = scene.plane(candidate.surface);
    const RationalVec n(plane.normal);
    t = real(rational_dot(rational_difference(plane.point, ray.origin), n) / rational_dot(n, d));
  } else if (candidate.meeting == Meeting::own_exit) {
    const double radius = scene.sphere(candidate.surface).radius;
    t = real(-2 * mpq_class(radius) * rational_dot(RationalVec(ray.from_normal), d) / a);
  } else {
    const Sphere& sphere = scene.sphere(candidate.surface);
    const mpq_class b = rational_dot(rational_difference(sphere.center, ray.origin), d);
    const mpq_class square = rational_discriminant(ray.origin, ray.direction, sphere.center, sphere.radius);
    const mpf_class root = square > 0 ? mpf_class(sqrt(real(square))) : mpf_class(0, kBits);
    t = (candidate.meeting == Meeting::entry ? mpf_class(real(b) - root) : mpf_class(real(b) + root)) / real(a);
  }
  return t > 0 ? t : mpf_class(0, kBits);
}

int order_of(const Scene& scene, const Ray& ray, const Candidate& a, const Candidate& b) {
  const mpf_class difference = distance(scene, ray, a) - distance(scene, ray, b);
  mpf_class threshold(1, kBits);
  mpf_div_2exp(threshold.get_mpf_t(), threshold.get_mpf_t(), 3000);
  return abs(difference) < threshold ? 0 : sgn(difference);
}

/// Every way in which `ray` can meet the surfaces of a scene, from inside the spheres that hold its origin.
std::vector<Candidate> candidates_of(const Scene& scene, const Ray& ray) {
  std::vector<Candidate> all;
  const DirectionNorm norm = norm_of(ray.direction);
  for (std::size_t i = 0; i != scene.sphere_count(); ++i) {
    const SurfaceId id = surface_id(i);
    const Sphere& sphere = scene.sphere(id);
    if (id == ray.from) {
      all.push_back({id, Meeting::own_exit, own_chord(ray, norm, sphere.radius)});
    } else if (side_of(ray.origin, sphere.center, sphere.radius) < 0) {
      all.push_back({id, Meeting::exit, exit_from(ray, norm, sphere.center, sphere.radius).t});
    } else if (const auto entry = entry_into(ray, norm, sphere.center, sphere.radius)) {
      all.push_back({id, Meeting::entry, entry->t});
    }
  }
  for (std::size_t i = 0; i != scene.data().planes.size(); ++i) {
    const Plane& plane = scene.data().planes[i];
    const auto t = distance_to(plane, ray, side_of(ray.origin, plane));
    if (t) all.push_back({scene.plane_id(i), Meeting::plane, *t});
  }
  return all;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(order)

// Spheres and planes through nearly one point of the ray, met from inside and outside.
BOOST_AUTO_TEST_CASE(surfaces_through_one_point_come_in_their_true_order) {
  Random random(41);
  int wrong = 0;
  int pairs = 0;
  int close = 0;
  for (int i = 0; i != 400; ++i) {
    const Vec3 origin = random.in_box(1);
    const Vec3 direction = random.over_decades(0.1, 10) * random.direction();
    const Vec3 point = origin + random.over_decades(0.01, 10) * direction;
    SceneData data;
    for (int k = 0; k != 5; ++k) {
      const Vec3 normal = random.direction();
      const double radius = random.over_decades(0.01, 100);
      const Vec3 center = point - radius * normal;
      add_sphere(data, center, length(point - center));
    }
    add_plane(data, point, random.direction());
    add_plane(data, point, random.direction());
    // The inner side of a sphere that the ray leaves and whose chord ends there too.
    const double radius = random.over_decades(1, 100);
    const double half = 0.5 * length(point - origin);
    Ray ray{.origin = origin, .direction = direction, .from = SurfaceId::none, .from_normal = {}};
    if (half < radius) {
      const double cosine = half / radius;
      ray.from_normal =
          -cosine * normalized(direction) + std::sqrt(1 - cosine * cosine) * random.perpendicular_to(direction);
      ray.from = surface_id(data.spheres.size());
      add_sphere(data, origin - radius * ray.from_normal, radius);
    }
    const Scene scene(data, Kernel::brute);
    const auto all = candidates_of(scene, ray);
    for (const Candidate& a : all) {
      for (const Candidate& b : all) {
        if (a.surface == b.surface) continue;
        const int exact = order_of(scene, ray, a, b);
        wrong += comes_first(scene, ray, a, b) != (exact < 0 || (exact == 0 && a.surface < b.surface));
        close += std::abs(a.t.value - b.t.value) <= a.t.error + b.t.error;
        ++pairs;
      }
    }
  }
  BOOST_TEST_MESSAGE(pairs << " pairs, " << close << " too close for double");
  BOOST_TEST(wrong == 0);
  BOOST_TEST(close > pairs / 10);
}

// Along x: spheres, a plane and an inner chord that all are met at exactly 5 (3-4-5, 5-12-13, 8-15-17 triangles).
BOOST_AUTO_TEST_CASE(exactly_equal_distances_go_to_the_lowest_surface) {
  SceneData data;
  add_sphere(data, {8, 4, 0}, 5);      // entry: 8 - 3
  add_sphere(data, {17, 0, 5}, 13);    // entry: 17 - 12
  add_sphere(data, {-10, 8, 0}, 17);   // exit: -10 + 15
  add_sphere(data, {2.5, 0, 0}, 2.5);  // own exit: 2 2.5
  add_sphere(data, {8, 4, 0}, 5);      // the first again
  add_plane(data, {5, 1, 2}, {1, 0, 0});
  add_plane(data, {0, 1, -4}, {4, 1, 5});  // 4 x + (y - 1) + 5 (z + 4) = 0 at x = -19 / 4: behind
  const Scene scene(data, Kernel::brute);
  const Ray ray{.origin = {}, .direction = {0.75, 0, 0}, .from = surface_id(3), .from_normal = {-1, 0, 0}};
  const auto all = candidates_of(scene, ray);
  BOOST_REQUIRE(all.size() == 6);
  for (const Candidate& a : all) {
    for (const Candidate& b : all) {
      BOOST_TEST(comes_first(scene, ray, a, b) == (a.surface < b.surface));
    }
  }
}

// An origin that rounding has put a hair inside two neighbours: both are at distance 0, the first is met.
BOOST_AUTO_TEST_CASE(distances_below_zero_are_equal) {
  SceneData data;
  add_sphere(data, {2, 0, 0}, 2.5);
  add_sphere(data, {1, 0, 0}, 1.25);
  const Scene scene(data, Kernel::brute);
  const Ray ray{.origin = {}, .direction = {1, 0, 0}};
  const DirectionNorm norm = norm_of(ray.direction);
  const Candidate a{surface_id(0), Meeting::entry, entry_into(ray, norm, {2, 0, 0}, 2.5)->t};
  const Candidate b{surface_id(1), Meeting::entry, entry_into(ray, norm, {1, 0, 0}, 1.25)->t};
  BOOST_TEST(comes_first(scene, ray, a, b));
  BOOST_TEST(!comes_first(scene, ray, b, a));
}

BOOST_AUTO_TEST_SUITE_END()
