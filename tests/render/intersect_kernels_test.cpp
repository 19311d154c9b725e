// SPDX-License-Identifier: BSD-3-Clause
// The tree against trying every sphere: the same surface, distance and normal, bit for bit.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdint>

#include "render/same_bits.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

/// Sends the same rays through both kernels and counts the answers that differ.
struct Comparison {
  Scene tree;
  Scene brute;
  int rays = 0;
  int hits = 0;
  int shadows = 0;
  int differences = 0;

  explicit Comparison(const SceneData& scene) : tree(scene, Kernel::automatic), brute(scene, Kernel::brute) {}

  std::optional<Hit> trace(const Ray& ray, const Region& in_tree, const Region& in_brute) {
    const std::optional<Hit> a = nearest_hit(tree, ray, in_tree);
    differences += !same_bits(a, nearest_hit(brute, ray, in_brute));
    ++rays;
    hits += a.has_value();
    return a;
  }

  /// A camera ray, then up to four mirror rays, with the shadow rays of every light at each hit.
  void follow(const Vec3& eye, const Vec3& direction) {
    const Region in_tree = region_at(tree, eye, direction);
    const Region in_brute = region_at(brute, eye, direction);
    differences += in_tree.walls() != in_brute.walls();
    Ray ray{.origin = eye, .direction = direction};
    for (int bounce = 0; bounce != 5; ++bounce) {
      const std::optional<Hit> hit = trace(ray, in_tree, in_brute);
      if (!hit) return;
      for (std::size_t i = 0; i != tree.data().lights.size(); ++i) {
        const Light& light = tree.data().lights[i];
        const Vec3 to_light = light.kind == LightKind::point ? light.vector - hit->point : -light.vector;
        const Ray shadow{hit->point, to_light, hit->surface, hit->normal};
        const bool facing = dot(to_light, hit->normal) * dot(ray.direction, hit->normal) < 0;
        if (!facing) continue;
        const bool occluded = is_occluded(tree, shadow, i, in_tree);
        differences += occluded != is_occluded(brute, shadow, i, in_brute);
        shadows += occluded;
      }
      const Vec3 mirrored = ray.direction - 2 * dot(ray.direction, hit->normal) * hit->normal;
      ray = {hit->point, mirrored, hit->surface, hit->normal};
    }
  }
};

Vec3 along_an_axis(Random& random) {
  const double zero = random.flip() ? 0.0 : -0.0;
  const double one = random.flip() ? 1 : -1;
  const std::uint32_t axis = random.below(3);
  return {axis == 0 ? one : zero, axis == 1 ? one : -zero, axis == 2 ? one : zero};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(intersect_kernels)

// Rays from anywhere to anywhere: eyes outside, inside and exactly on a lattice, a quarter of the rays along an axis.
BOOST_AUTO_TEST_CASE(tree_and_brute_force_agree_to_the_bit) {
  for (const SceneKind& kind : scene_kinds()) {
    for (const std::uint64_t seed : {51U, 52U}) {
      Comparison comparison(random_scene(kind, seed));
      Random random(seed);
      for (int i = 0; i != 1500; ++i) {
        Vec3 eye = kind.center + random.in_box((i % 3 == 0 ? 1.0 : 3.0) * kind.size);
        if (i % 4 == 0) eye = {std::round(eye.x), std::round(eye.y), std::round(eye.z)};
        const Sphere& aim = comparison.tree.spheres()[random.below(12)];
        const Vec3 target = aim.center + random.in_box(1.5 * aim.radius);
        comparison.follow(eye, i % 4 < 2 ? along_an_axis(random) : random.over_decades(1e-3, 1e3) * (target - eye));
      }
      BOOST_TEST_MESSAGE(kind.name << ": " << comparison.rays << " rays, " << comparison.hits << " hits, "
                                   << comparison.shadows << " in shadow");
      BOOST_TEST(comparison.differences == 0, kind.name << ": " << comparison.differences << " answers differ");
      BOOST_TEST(comparison.hits > 300, kind.name << ": " << comparison.hits << " hits");
    }
  }
}

// Rays that touch a sphere at the sides of its box: along the faces, and aimed at the poles.
BOOST_AUTO_TEST_CASE(rays_that_touch_boxes_agree_to_the_bit) {
  for (const SceneKind& kind : scene_kinds()) {
    const SceneData data = random_scene(kind, 54);
    Comparison comparison(data);
    Random random(54);
    for (int i = 0; i != 1500; ++i) {
      const Sphere& sphere = data.spheres[random.below(static_cast<std::uint32_t>(data.spheres.size()))];
      const Vec3 direction = along_an_axis(random);
      const Vec3 side = cross(direction, along_an_axis(random));
      comparison.follow(sphere.center + sphere.radius * side - 16.0 * direction, direction);
      const Vec3 eye = kind.center + random.in_box(4 * kind.size);
      comparison.follow(eye, sphere.center + sphere.radius * along_an_axis(random) - eye);
    }
    BOOST_TEST(comparison.differences == 0, kind.name << ": " << comparison.differences << " answers differ");
  }
}

BOOST_AUTO_TEST_SUITE_END()
