// SPDX-License-Identifier: BSD-3-Clause
// Points of many entries at once against the points of one after the other, bit for bit.
#include "render/entry_points.h"

#include <boost/test/unit_test.hpp>
#include <vector>

#include "render/kernels.h"
#include "render/same_bits.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

/// Rays that enter spheres of one scene, and which they enter.
struct Entries {
  std::vector<RayInRegion> rays;
  std::vector<SureEntry> entries;

  void add(const Scene& scene, const Vec3& eye, const Vec3& direction, SurfaceId id) {
    const Ray ray{.origin = eye, .direction = direction};
    const Sphere& sphere = scene.sphere(id);
    if (!is_squarable(dot(direction, direction)) || side_of(eye, sphere.center, sphere.radius) < 0) return;
    rays.push_back({ray, nullptr});
    if (!entry_into(ray, norm_of(direction), sphere.center, sphere.radius)) return;
    entries.push_back({static_cast<std::uint32_t>(rays.size() - 1), id});
  }
};

/// Rays to anywhere on spheres, to their very centres, along their rims, and from their surfaces; short and long ones.
Entries entries_into(const Scene& scene, const SceneKind& kind, std::uint64_t seed) {
  Entries all;
  Random random(seed);
  const double lengths[] = {1e-30, 0.5, 1, 1e30};
  for (int i = 0; i != 4000; ++i) {
    const SurfaceId id = surface_id(random.below(static_cast<std::uint32_t>(scene.sphere_count())));
    const auto& [center, radius, material] = scene.sphere(id);
    Vec3 eye = kind.center + random.in_box(3 * kind.size);
    if (i % 7 == 0) eye = center + Vec3{2 * radius, 0, 0};
    if (i % 7 == 1) eye = center + radius * random.direction();
    Vec3 aim = center + random.in_box(1.2 * radius);
    if (i % 5 == 0) aim = center;
    if (i % 5 == 1) aim = center + radius * random.perpendicular_to(random.direction());
    if (eye == aim) continue;
    all.add(scene, eye, lengths[i % 4] * normalized(aim - eye), id);
  }
  return all;
}

/// Of the first `size` entries.
int differences_in_points(const Scene& scene, const Entries& all, std::size_t size) {
  const SurfacePoint untouched{surface_id(99), {1, 2, 3}, {4, 5, 6}};
  std::vector<std::optional<SurfacePoint>> points(all.rays.size(), untouched);
  std::vector<std::optional<SurfacePoint>> expected = points;
  const auto entries = std::span(all.entries).first(size);
  entry_points(scene, all.rays, entries, points);
  for (const auto& [ray, sphere] : entries) expected[ray] = entry_point(scene, all.rays[ray].ray, sphere);
  int differences = 0;
  for (std::size_t i = 0; i != points.size(); ++i) differences += !same_bits(points[i], expected[i]);
  return differences;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(entry_points_of_batches)

BOOST_AUTO_TEST_CASE(points_of_batches_of_every_size_are_those_of_single_rays_to_the_bit) {
  for (const SceneKind& kind : scene_kinds()) {
    const SceneData data = random_scene(kind, 67);
    for (const auto& [kernel, name] : supported_kernels()) {
      const Scene scene(data, kernel);
      const Entries all = entries_into(scene, kind, 67);
      BOOST_TEST_REQUIRE(all.entries.size() > 500U, kind.name);
      for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{4},
                                     std::size_t{9}, all.entries.size()}) {
        BOOST_TEST(differences_in_points(scene, all, size) == 0, name << ", " << kind.name << ", " << size);
      }
    }
  }
}

// So small that squares vanish: then all lengths are taken of scaled vectors.
BOOST_AUTO_TEST_CASE(points_on_spheres_too_small_to_square_are_those_of_single_rays) {
  SceneData data;
  Random random(68);
  for (const double radius : {1e-20, 1e-31, 1e-60, 1e-140}) {
    for (int i = 0; i != 5; ++i) add_sphere(data, 3 * radius * random.direction(), radius);
  }
  for (const auto& [kernel, name] : supported_kernels()) {
    const Scene scene(data, kernel);
    Entries all;
    for (int i = 0; i != 2000; ++i) {
      const SurfaceId id = surface_id(random.below(20));
      const auto& [center, radius, material] = scene.sphere(id);
      const Vec3 eye = i % 2 == 0 ? random.in_box(1) : center + random.in_box(10 * radius);
      all.add(scene, eye, i % 3 == 0 ? center - eye : normalized(center + random.in_box(radius) - eye), id);
    }
    BOOST_TEST_REQUIRE(all.entries.size() > 300U);
    BOOST_TEST(differences_in_points(scene, all, all.entries.size()) == 0, name);
  }
}

BOOST_AUTO_TEST_CASE(point_is_where_the_nearest_hit_is) {
  SceneData data;
  add_sphere(data, {1, 2, 3}, 0.5);
  for (const auto& [kernel, name] : supported_kernels()) {
    const Scene scene(data, kernel);
    const RayInRegion rays[] = {{{.origin = {1, 2, 9}, .direction = {0, 0, -2}}, nullptr}};
    const SureEntry entries[] = {{0, surface_id(0)}};
    std::optional<SurfacePoint> points[1];
    entry_points(scene, rays, entries, points);
    BOOST_TEST_REQUIRE(points[0].has_value(), name);
    BOOST_TEST((points[0]->surface == surface_id(0)), name);
    BOOST_TEST((points[0]->point == Vec3{1, 2, 3.5}), name);
    BOOST_TEST((points[0]->normal == Vec3{0, 0, 1}), name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
