// SPDX-License-Identifier: BSD-3-Clause
// Decisions that are hard to take, by the million: the cases that the long runs repeat with other seeds.
#include "render/camera_paths.h"
#include "render/same_bits.h"
#include "render/sphere.h"
#include "stress/stress_scene.h"
#include "stress/tangency.h"

using namespace tessera::stress;

namespace {

constexpr int kDecisions = 1000000;

/// x moved by up to three units in its last place.
double nudged(Random& random, double x) {
  for (std::uint32_t i = random.below(4); i > 0; --i) x = std::nextafter(x, random.flip() ? 1e300 : -1e300);
  return x;
}
Vec3 nudged(Random& random, const Vec3& v) {
  return {nudged(random, v.x), nudged(random, v.y), nudged(random, v.z)};
}

/// A line and a sphere that it all but touches.
struct NearTangent {
  Ray ray;
  Vec3 center;
  double radius;
};

/// Made of short numbers on the triangle 3, 4, 5, so that it touches exactly, or with the next radius below or above.
NearTangent exact_tangent(Random& random) {
  const auto whole = [&](std::uint32_t bound) { return static_cast<double>(1 + random.below(bound)); };
  const double unit = whole(1 << 20) * 0x1p-20;
  const Vec3 center{whole(1 << 20) * 0x1p-20, whole(1 << 20) * 0x1p-20, whole(1 << 20) * 0x1p-20};
  const Vec3 direction{3, 4, 0};
  const Vec3 touch = center + unit * Vec3{-4, 3, 0};
  const double radius = 5 * unit;
  const double radii[] = {std::nextafter(radius, 0), radius, std::nextafter(radius, 1e9)};
  return {{touch - whole(1 << 20) * direction, direction * std::ldexp(1, static_cast<int>(random.below(40)) - 20)},
          center,
          radii[random.below(3)]};
}

std::optional<Hit> hit_in(const Scene& scene, const Region& region, const Vec3& eye, const Vec3& direction) {
  return nearest_hit(scene, {.origin = eye, .direction = direction}, region);
}

bool is_same(const std::optional<Hit>& a, const std::optional<Hit>& b) {
  return a.has_value() == b.has_value() && (!a || (a->surface == b->surface && a->t == b->t));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(decision_cases)

BOOST_AUTO_TEST_CASE(case_09_rays_within_three_ulps_of_tangency) {
  Verdict verdict(9, "no wrong decision against exact arithmetic, D/r 10 to 1e9");
  Random random(seed_of(9));
  TangencyOracle oracle;
  std::size_t wrong = 0;
  std::size_t hits = 0;
  const int count = scaled_count(kDecisions);
  const auto decide = [&](const NearTangent& near) {
    const bool exact = oracle.meets(near.ray.origin, near.ray.direction, near.center, near.radius);
    hits += exact;
    wrong += entry_into(near.ray, norm_of(near.ray.direction), near.center, near.radius).has_value() != exact;
  };
  constexpr int kAims = 4;
  for (int i = 0; i < count; i += kAims) {
    const Vec3 direction = random.direction();
    const Vec3 center = random.in_box(1);
    const double radius = nudged(random, random.over_decades(1e-3, 1));
    const Vec3 touch = center + radius * random.perpendicular_to(direction);
    const Vec3 origin = nudged(random, touch - radius * random.over_decades(10, 1e9) * direction);
    for (int aim = 0; aim != kAims; ++aim) {
      if (aim == 0 && i % 64 == 0) {
        decide(exact_tangent(random));
        continue;
      }
      // Aim at the point of contact again, for the origin is rounded to far more than ulps of the radius.
      decide({{.origin = origin, .direction = nudged(random, touch - origin)}, center, radius});
    }
  }
  verdict.none_wrong("rays", wrong, static_cast<std::size_t>(count));
  const double share = static_cast<double>(hits) / count;
  verdict.require(share > 0.2 && share < 0.8, "both hits and misses");
  verdict.require(oracle.disagreements() == 0,
                  std::to_string(oracle.unsure()) + " of them decided by rationals, which confirm quad precision else");
}

// Along any ray to the centre the outer shell comes first, and from within the inner one.
BOOST_AUTO_TEST_CASE(case_23_concentric_shells) {
  Verdict verdict(23, "outside the outer wins, inside the inner");
  Random random(seed_of(23));
  std::size_t wrong = 0;
  std::size_t tried = 0;
  const auto count = static_cast<std::size_t>(scaled_count(kDecisions));
  for (int round = 0; tried < count; ++round) {
    const int k = 1 + round % 16;
    const double r = random.uniform(0.5, 1);
    const double larger = k < 16 ? r * (1 + std::pow(10.0, -k)) : std::nextafter(r, 2);
    const bool inner_first = random.flip();
    const std::size_t inner = inner_first ? 0 : 1;
    const Vec3 center{0.25, 0, 0};
    SceneData data;
    add_sphere(data, center, inner_first ? r : larger);
    add_sphere(data, center, inner_first ? larger : r);
    const Scene scene(data, Kernel::automatic);
    // All eyes are 3 or 0.4 from the centre.
    const Region outside = region_at(scene, center + Vec3{3, 0, 0}, {1, 0, 0});
    const Region inside = region_at(scene, center, {1, 0, 0});
    for (int i = 0; i != 500; ++i) {
      const Vec3 away = random.direction();
      const auto out = hit_in(scene, outside, center + 3 * away, 0.3 * random.direction() - away);
      if (out) wrong += index_of(out->surface) != 1 - inner;
      const auto in = hit_in(scene, inside, center + 0.4 * away, random.direction());
      wrong += !in || index_of(in->surface) != inner;
      tried += out ? 2u : 1u;
    }
  }
  verdict.none_wrong("rays", wrong, tried);
}

// Rays through corners and edges of the boxes around spheres, along the axes with both zeros and across them.
BOOST_AUTO_TEST_CASE(case_43_rays_through_box_corners) {
  Verdict verdict(43, "no hit lost");
  Random random(seed_of(43));
  std::size_t wrong = 0;
  std::size_t wrong_together = 0;
  std::size_t misplaced = 0;
  std::size_t hits = 0;
  int tried = 0;
  const int count = scaled_count(kDecisions);
  for (int round = 0; tried < count; ++round) {
    // Where brute force checks each of many rays, few spheres must do; now and then there are more.
    const std::uint32_t spheres = round % 40 == 0 ? 300 : 40;
    const double half_side = round % 40 == 0 ? 5 : 2.5;
    const double offset = round % 3 == 0 ? 0.0 : round % 3 == 1 ? 1e2 : 1e6;
    SceneData data;
    for (std::uint32_t i = 0; i != spheres; ++i) {
      const Vec3 place = random.in_box(half_side);
      const Vec3 grid{std::floor(place.x), std::floor(place.y), std::floor(place.z)};
      add_sphere(data, grid + Vec3{offset, offset, offset}, 0.5);
    }
    const Scene tree = prepared(data);
    const Scene brute = prepared(data, Kernel::brute);
    CameraPaths rays;
    std::vector<std::optional<Hit>> hits_alone;
    for (int i = 0; i != 3000; ++i, ++tried) {
      const Sphere& aim = tree.sphere(surface_id(random.below(spheres)));
      const auto side = [&] { return (static_cast<double>(random.below(3)) - 1) * aim.radius; };
      const Vec3 corner = aim.center + Vec3{side(), side(), side()};
      const double zero = random.flip() ? 0.0 : -0.0;
      const Vec3 axes[] = {{1, zero, zero}, {zero, -1, zero}, {-zero, zero, 1}, {1, 1, zero}, {1, -1, 1}};
      const Vec3 direction = axes[random.below(5)];
      const Vec3 eye = corner - 24 * aim.radius * direction;
      const Placement placement = tree.placement_of(eye);
      if (i % 16 == 0) {
        const Placement by_brute = brute.placement_of(eye);
        misplaced += by_brute.enclosing != placement.enclosing || by_brute.touching != placement.touching;
      }
      const Region region(tree, placement, eye, direction);
      const auto hit = hit_in(brute, region, eye, direction);
      wrong += !is_same(hit_in(tree, region, eye, direction), hit);
      hits += hit.has_value();
      rays.add({.origin = eye, .direction = direction}, region);
      hits_alone.push_back(hit);
    }
    // Many at a time, as the fastest kernel traces them
    const auto hits_of_all = hits_together(tree, rays.rays);
    for (std::size_t i = 0; i != hits_alone.size(); ++i) wrong_together += !same_bits(hits_of_all[i], hits_alone[i]);
  }
  verdict.none_wrong("rays", wrong, static_cast<std::size_t>(tried));
  verdict.none_wrong("rays together", wrong_together, static_cast<std::size_t>(tried));
  verdict.none_wrong("eyes misplaced", misplaced, static_cast<std::size_t>(tried / 16));
  verdict.require(hits > 0 && hits < static_cast<std::size_t>(tried), "both hits and misses");
}

// The point of a hit, and the mirror ray from there: the sphere itself is not met again, a neighbour that all but
// touches is not lost.
BOOST_AUTO_TEST_CASE(case_45_leaving_a_surface) {
  Verdict verdict(45, "no false self-hit, no neighbour lost at a gap of 1e-12");
  Random random(seed_of(45));
  std::size_t self = 0;
  std::size_t left = 0;
  std::size_t lost = 0;
  std::size_t neighbours = 0;
  const auto count = static_cast<std::size_t>(scaled_count(kDecisions));
  while (left + neighbours < count) {
    const double r = random.over_decades(1e-8, 1e8);
    const Vec3 center = r * random.in_box(random.over_decades(1, 1e3));
    const Vec3 axis = random.direction();
    SceneData data;
    add_sphere(data, center, r);
    add_sphere(data, center + (2 + 1e-12) * r * axis, r);
    const Scene scene = prepared(data);
    const Sphere& own = scene.sphere(surface_id(0));
    // All eyes are 5 radii from the centre, outside of both.
    const Region region = region_at(scene, own.center + 5 * own.radius * axis, axis);
    BOOST_REQUIRE(region.walls().empty());
    for (int k = 0; k != 500; ++k) {
      const Vec3 away = random.direction();
      const Vec3 eye = own.center + 5 * own.radius * away;
      // A third of the rays graze, a third all but touch.
      const double depth = k % 3 == 1 ? random.over_decades(1e-15, 1e-3) : 0x1p-53 * random.below(8);
      const Vec3 aim = k % 3 == 0 ? random.in_box(0.7) : (1 - depth) * random.perpendicular_to(away);
      const Vec3 direction = own.center + own.radius * aim - eye;
      const auto hit = hit_in(scene, region, eye, direction);
      if (hit) {
        const Vec3 leaving = direction - 2 * dot(hit->normal, direction) * hit->normal;
        const auto next = nearest_hit(scene, {hit->point, leaving, hit->surface, hit->normal}, region);
        self += next && next->surface == hit->surface;
        ++left;
      }
      // From the point that faces the neighbour, straight at it.
      if (!(dot(away, axis) > 0)) continue;
      const auto neighbour =
          nearest_hit(scene, {own.center + own.radius * axis, axis + 0.5 * away, surface_id(0), axis}, region);
      lost += !neighbour || index_of(neighbour->surface) != 1;
      ++neighbours;
    }
  }
  verdict.none_wrong("self-hits", self, left);
  verdict.none_wrong("neighbours lost", lost, neighbours);
}

BOOST_AUTO_TEST_SUITE_END()
