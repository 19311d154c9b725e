// SPDX-License-Identifier: BSD-3-Clause
// Many rays at once against one after the other and every sphere tried: the same answers, bit for bit.
#include "render/stream.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <deque>
#include <vector>

#include "render/kernels.h"
#include "render/same_bits.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

/// Lengths of directions: the first and the last have squares that are no numbers.
constexpr double kLengths[] = {1e-180, 1e-30, 1, 1e30, 1e180};

constexpr std::size_t kSizes[] = {0, 1, 31, 32, 33, 500};

/// Rays through a scene, each in the region of its own eye, and what brute force finds.
struct Rays {
  const Scene& brute;
  std::deque<Region> regions;
  std::vector<RayInRegion> rays;
  std::vector<std::optional<Hit>> hits;

  void add(const Ray& ray, const Region& region) {
    rays.push_back({ray, &region});
    hits.push_back(nearest_hit(brute, ray, region));
  }

  /// A camera ray, and what a mirror makes of it.
  void follow(const Vec3& eye, const Vec3& direction, double mirror_length) {
    const Region& region = regions.emplace_back(region_at(brute, eye, direction));
    add({.origin = eye, .direction = direction}, region);
    if (!hits.back()) return;
    const Hit hit = *hits.back();
    const Vec3 d = normalized(direction);
    add({hit.point, mirror_length * (d - 2 * dot(d, hit.normal) * hit.normal), hit.surface, hit.normal}, region);
  }
};

double one_of(Random& random, std::span<const double> numbers) {
  return numbers[random.below(static_cast<std::uint32_t>(numbers.size()))];
}

Vec3 along_an_axis(Random& random) {
  const double one = random.flip() ? 1 : -1;
  const double zeros[] = {0.0, -0.0};
  Vec3 d{one_of(random, zeros), one_of(random, zeros), one_of(random, zeros)};
  const std::uint32_t axis = random.below(3);
  (axis == 0 ? d.x : axis == 1 ? d.y : d.z) = one;
  return d;
}

/// Outside, inside and on a sphere: exactly on it where the sum does not round.
Vec3 some_eye(Random& random, const SceneKind& kind, const Sphere& sphere) {
  switch (random.below(4)) {
    case 0:
      return kind.center + random.in_box(3 * kind.size);
    case 1:
      return sphere.center + random.in_box(0.5 * sphere.radius);
    case 2:
      return sphere.center + sphere.radius * along_an_axis(random);
    default: {
      const Vec3 p = kind.center + random.in_box(2 * kind.size);
      return {std::round(p.x), std::round(p.y), std::round(p.z)};
    }
  }
}

Rays rays_through(const Scene& brute, const SceneKind& kind, std::uint64_t seed) {
  Rays all{brute, {}, {}, {}};
  Random random(seed);
  const auto some_sphere = [&] { return brute.spheres()[random.below(12)]; };
  while (all.rays.size() < 500) {
    const Vec3 eye = some_eye(random, kind, some_sphere());
    const Sphere aim = some_sphere();
    Vec3 direction = along_an_axis(random);
    if (random.flip()) direction = aim.center + random.in_box(1.5 * aim.radius) - eye;
    if (dot(direction, direction) == 0) continue;
    all.follow(eye, one_of(random, kLengths) * normalized(direction), one_of(random, kLengths));
  }
  return all;
}

int differences_in_hits(const Scene& scene, const Rays& all) {
  int differences = 0;
  for (const std::size_t size : kSizes) {
    const std::size_t first = size < 400 ? size : 0;
    std::vector<std::optional<SurfacePoint>> hits(size, SurfacePoint{surface_id(99), {}, {}});
    nearest_hits(scene, std::span(all.rays).subspan(first, size), hits);
    for (std::size_t i = 0; i != size; ++i) differences += !same_bits(hits[i], all.hits[first + i]);
  }
  return differences;
}

/// Rays to one light from where others hit, in many regions.
std::vector<RayInRegion> rays_to(const Light& light, const Rays& all, Random& random) {
  std::vector<RayInRegion> rays;
  for (std::size_t i = 0; i != all.rays.size(); ++i) {
    const auto& hit = all.hits[i];
    if (!hit) continue;
    const Vec3 way =
        light.kind == LightKind::point ? light.vector - hit->point : -one_of(random, kLengths) * light.vector;
    if (way == Vec3{}) continue;
    rays.push_back({{hit->point, way, hit->surface, hit->normal}, all.rays[i].region});
  }
  return rays;
}

/// Of all sizes of batches; also counts rays that are occluded.
int differences_in_shadows(const Scene& scene, const Scene& brute, std::span<const RayInRegion> rays, std::size_t light,
                           int& shadows) {
  int differences = 0;
  for (std::size_t size : kSizes) {
    size = std::min(size, rays.size());
    std::vector<std::uint8_t> occluded(size, 7);
    occlusions(scene, rays.first(size), light, occluded);
    for (std::size_t i = 0; i != size; ++i) {
      const bool expected = is_occluded(brute, rays[i].ray, light, *rays[i].region);
      differences += occluded[i] != (expected ? 1 : 0);
      shadows += expected;
    }
  }
  return differences;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(stream)

BOOST_AUTO_TEST_CASE(batches_of_every_size_find_the_hits_of_brute_force_to_the_bit) {
  for (const SceneKind& kind : scene_kinds()) {
    for (const std::uint64_t seed : {61U, 62U}) {
      const SceneData data = random_scene(kind, seed);
      const Scene brute(data, Kernel::brute);
      const Rays all = rays_through(brute, kind, seed);
      for (const auto& [kernel, name] : supported_kernels()) {
        BOOST_TEST(differences_in_hits(Scene(data, kernel), all) == 0, name << ", " << kind.name);
      }
      const auto hits =
          std::count_if(all.hits.begin(), all.hits.end(), [](const auto& hit) { return hit.has_value(); });
      BOOST_TEST(hits > 100, kind.name << ": " << hits << " hits");
    }
  }
}

// Lights as the scene has them, and point lights so near and so far that the way there has no square.
BOOST_AUTO_TEST_CASE(batches_of_every_size_find_the_shadows_of_brute_force) {
  int shadows = 0;
  for (const SceneKind& kind : scene_kinds()) {
    for (const std::uint64_t seed : {63U, 64U}) {
      SceneData data = random_scene(kind, seed);
      add_point_light(data, 1e40 * normalized(Vec3{1, 2, 3}));
      const Scene brute(data, Kernel::brute);
      const Rays all = rays_through(brute, kind, seed);
      for (const auto& [kernel, name] : supported_kernels()) {
        const Scene scene(data, kernel);
        for (std::size_t light = 0; light != data.lights.size(); ++light) {
          Random random(seed);
          const auto rays = rays_to(data.lights[light], all, random);
          BOOST_TEST(differences_in_shadows(scene, brute, rays, light, shadows) == 0,
                     name << ", " << kind.name << ", light " << light);
        }
      }
    }
  }
  BOOST_TEST(shadows > 1000);
}

BOOST_AUTO_TEST_CASE(way_to_a_light_may_be_too_short_to_square) {
  SceneData data = random_scene(scene_kinds()[0], 65);
  add_point_light(data, {0, 0, 0});
  add_sphere(data, {3e-36, 0, 0}, 2e-36);
  const Scene brute(data, Kernel::brute);
  Random random(65);
  std::deque<Region> regions;
  std::vector<RayInRegion> rays;
  for (int i = 0; i != 500; ++i) {
    const Vec3 origin =
        random.over_decades(1e-45, 1e-31) * random.direction() + Vec3{random.flip() ? 4e-36 : 0.0, 0, 0};
    regions.push_back(region_at(brute, origin, -origin));
    rays.push_back({{.origin = origin, .direction = -origin}, &regions.back()});
  }
  int shadows = 0;
  for (const auto& [kernel, name] : supported_kernels()) {
    const Scene scene(data, kernel);
    BOOST_TEST(differences_in_shadows(scene, brute, rays, data.lights.size() - 1, shadows) == 0, name);
  }
  BOOST_TEST(shadows > 30);
}

// A tree without a node: planes alone, spheres that are never hit, nothing.
BOOST_AUTO_TEST_CASE(scenes_without_spheres_have_answers) {
  for (const auto& [kernel, name] : supported_kernels()) {
    for (int with_points = 0; with_points != 2; ++with_points) {
      SceneData data;
      for (int i = 0; i != 10 * with_points; ++i) add_sphere(data, {0, 0, -0.1 * i}, 0);
      add_plane(data, {0, 0, -1}, {0, 0, 1});
      add_point_light(data, {0, 0, 3});
      const Scene scene(data, kernel);
      const Region region = region_at(scene, {0, 0, 1}, {0, 0, -1});
      const RayInRegion rays[] = {{{.origin = {0, 0, 1}, .direction = {0, 0, -1}}, &region},
                                  {{.origin = {0, 0, 1}, .direction = {0, 1, 0}}, &region}};
      std::optional<SurfacePoint> hits[2] = {std::nullopt, SurfacePoint{}};
      nearest_hits(scene, rays, hits);
      BOOST_TEST_REQUIRE(hits[0].has_value());
      BOOST_TEST((hits[0]->point == Vec3{0, 0, -1}));
      BOOST_TEST(!hits[1]);
      const RayInRegion to_light[] = {{{{0, 0, -1}, {0, 0, 4}, hits[0]->surface, {0, 0, 1}}, &region}};
      std::uint8_t occluded[] = {7};
      occlusions(scene, to_light, 0, occluded);
      BOOST_TEST(occluded[0] == 0);
    }
  }
}

// All boxes are entered at once, and the stack is as full as a tree of this size can make it.
BOOST_AUTO_TEST_CASE(a_thousand_spheres_in_one_place_are_all_looked_at) {
  SceneData data;
  for (int i = 0; i != 1000; ++i) add_sphere(data, {1, 2, 3}, 0.5 + 0.5 / (1000 - i));
  add_point_light(data, {1, 2, 9});
  const Scene brute(data, Kernel::brute);
  Rays all{brute, {}, {}, {}};
  Random random(66);
  while (all.rays.size() < 500) {
    const Vec3 eye = Vec3{1, 2, 3} + 4 * random.direction();
    all.follow(eye, Vec3{1, 2, 3} + random.in_box(1) - eye, 1);
  }
  for (const auto& [kernel, name] : supported_kernels()) {
    BOOST_TEST(differences_in_hits(Scene(data, kernel), all) == 0, name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
