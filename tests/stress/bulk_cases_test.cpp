// SPDX-License-Identifier: BSD-3-Clause
// Many spheres, in places that are hard on a tree. TESSERA_STRESS_SCALE=100 makes them 1e7 and 1e6.
#include <utility>

#include "render/camera_paths.h"
#include "stress/near_spheres.h"
#include "stress/stress_scene.h"

using namespace tessera::stress;

namespace {

constexpr std::uint32_t kSide = 32;  ///< of the picture

/// Matte materials of as many colours, and a mirror in eight.
SceneData with_materials(Random& random) {
  SceneData data;
  for (int i = 0; i != 64; ++i) {
    Material material{.color = {random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)}};
    material.reflection = i % 8 == 0 ? 0.5 : 0;
    add_material(data, material);
  }
  data.environment.background = {0.1, 0.3, 0.5};
  data.image.max_bounces = 1;
  return data;
}

void put(SceneData& data, Random& random, const Vec3& center, double radius) {
  data.spheres.push_back({center, radius, static_cast<MaterialIndex>(random.below(64))});
}

SceneData random_spheres(int count) {
  Random random(140);
  SceneData data = with_materials(random);
  const double spacing = 2 / std::cbrt(count);
  for (int i = 0; i != count; ++i) put(data, random, random.in_box(1), spacing * random.uniform(0.15, 0.3));
  data.camera = Camera{.eye = {2.5, -4, 2}, .target = {}};
  add_point_light(data, {4, -3, 5});
  add_directional_light(data, {1, 1, -2}, {0.5, 0.5, 0.5});
  return data;
}

SceneData one_center(int count) {
  Random random(141);
  SceneData data = with_materials(random);
  for (int i = 0; i != count; ++i) put(data, random, {0.25, 0.5, -0.125}, random.uniform(0.5, 1));
  data.camera = Camera{.eye = {2.5, -3, 1}, .target = {0.25, 0.5, -0.125}, .fov = 35};
  add_point_light(data, {4, -3, 5});
  return data;
}

SceneData on_a_line(int count) {
  Random random(142);
  SceneData data = with_materials(random);
  for (int i = 0; i != count; ++i) put(data, random, {random.uniform(-1, 1), 0, 0}, random.over_decades(1e-4, 3e-2));
  data.camera = Camera{.eye = {-1.1, -0.2, 0.1}, .target = {-0.6, 0, 0}, .fov = 30};
  add_point_light(data, {-2, -3, 5});
  add_directional_light(data, {-1, 0.1, -0.05}, {0.5, 0.5, 0.5});
  return data;
}

/// Around the eye, at distances so many times the radius that about three spheres stand in each direction: of any size.
/// A mirror of the smallest would spread the roundings of one hit over the largest, so there are none.
SceneData radii_over_decades(int count) {
  Random random(143);
  SceneData data = with_materials(random);
  data.image.max_bounces = 0;
  for (int i = 0; i != count; ++i) {
    const double radius = random.over_decades(1e-6, 1e6);
    put(data, random, radius * std::sqrt(count / 12.0) * random.uniform(0.8, 1.2) * random.direction(), radius);
  }
  data.camera = Camera{.eye = {}, .target = {1, 2, 0.5}, .fov = 90};
  add_point_light(data, {1e-3, 2e-3, 1e-3});
  add_point_light(data, {-3e3, 1e3, -2e3});
  return data;
}

/// The levels of a tree's inner nodes.
int depth_of(const Bvh& bvh) {
  int deepest = 0;
  std::vector<std::pair<std::uint32_t, int>> open{{0, 1}};
  while (!open.empty()) {
    const auto [index, depth] = open.back();
    open.pop_back();
    deepest = std::max(deepest, depth);
    const TreeNode& node = bvh.nodes()[index];
    for (int i = 0; i != kTreeWidth; ++i) {
      const bool is_there = !bvh.child_box(node, i).is_empty();
      if (is_there && !TreeChild::is_leaf(node.child[i])) open.emplace_back(node.child[i], depth + 1);
    }
  }
  return deepest;
}

/// One pixel's path as rendered: the surface seen first and every ray that was asked about. If the first wrong answer
/// of all is to ray n, the rays up to n are as they should be but for roundings, and so the spheres near them are all
/// that quad precision needs to find the right answer to ray n: to ask about the renderer's rays hides no error.
class PixelPath {
 public:
  PixelPath(const Scene& scene, const Region& region, const Ray& camera_ray) {
    Ray ray = camera_ray;
    double spread = 1;
    for (std::uint32_t bounce = 0;; ++bounce) {
      segments.push_back({ray.origin, ray.direction});
      const auto hit = nearest_hit(scene, ray, region);
      if (!hit) return;
      if (bounce == 0) first = hit->surface;
      for (const Light& light : scene.data().lights) {
        const bool is_point = light.kind == LightKind::point;
        const Vec3 reach = is_point ? light.vector - hit->point : -light.vector;
        if (dot(hit->normal, reach) < -1e-9 * length(reach)) continue;
        segments.push_back({hit->point, reach, is_point ? 1 : std::numeric_limits<double>::infinity(), true});
      }
      const Sphere& sphere = scene.sphere(hit->surface);
      if (bounce == scene.data().image.max_bounces || !(scene.material(sphere.material).reflection > 0)) {
        return;
      }
      const double cosine = std::abs(dot(hit->normal, ray.direction));
      // A convex mirror spreads what is off by 1 + 2 t / (r cos), and 16u times that is what a direction is off by.
      spread *= 1 + 2 * hit->t * dot(ray.direction, ray.direction) / (sphere.radius * cosine);
      if (16 * kUnitRoundoff * spread > 0.5e-9) is_within_slack = false;
      ray = {hit->point, ray.direction - 2 * dot(hit->normal, ray.direction) * hit->normal, hit->surface, hit->normal};
    }
  }

  std::optional<SurfaceId> first;
  std::vector<Segment> segments;
  bool is_within_slack = true;  ///< of spheres_near
};

void check_bulk(Verdict& verdict, const std::string& name, SceneData data) {
  const Scene scene(unit_scaled(std::move(data)), Kernel::automatic);
  const int depth = depth_of(scene.bvh());
  verdict.require(depth <= Bvh::kMaxDepth, name + " (" + std::to_string(scene.sphere_count()) + "): depth " +
                                               std::to_string(depth) + ", " +
                                               std::to_string(scene.bvh().memory_bytes() >> 20) + " MiB of tree");
  const CameraRays rays(*scene.data().camera, kSide, kSide);
  const Ray center = rays.through(0, 0);
  const Region region = region_at(scene, center.origin, center.direction);
  bool is_outside = region.walls().empty();
  for (std::size_t i = 0; i != scene.data().lights.size(); ++i) {
    is_outside = is_outside && scene.light_placement(i).enclosing.empty();
  }
  verdict.require(is_outside, "eye and lights outside");

  // All rays of all paths, for one look at all spheres
  std::vector<PixelPath> paths;
  std::vector<Segment> segments;
  for (std::uint32_t i = 0; i != kSide * kSide; ++i) {
    paths.emplace_back(scene, region, rays.through(i % kSide + 0.5, i / kSide + 0.5));
    segments.insert(segments.end(), paths.back().segments.begin(), paths.back().segments.end());
  }
  const auto near = spheres_near(scene.spheres(), segments);

  std::vector<Sphere> part;
  std::size_t wrong = 0;
  std::size_t tried = 0;
  std::size_t hits = 0;
  CameraPaths compared;
  std::vector<Rgb> alone;
  auto of_path = near.begin();
  for (const PixelPath& path : paths) {
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i != path.segments.size(); ++i, ++of_path) {
      indices.insert(indices.end(), of_path->begin(), of_path->end());
    }
    if (!path.is_within_slack) continue;
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    part.clear();
    for (const std::uint32_t index : indices) part.push_back(scene.spheres()[index]);

    const Segment& ray = path.segments[0];
    const QuadTracer reference({part, scene.view().materials, scene.data()}, ray.origin, ray.direction);
    const auto exact = reference.first_hit();
    const QuadVec radiance = reference.radiance();
    const Rgb seen = seen_from(scene, ray.origin, ray.direction);
    const bool is_first_right =
        path.first.has_value() == exact.has_value() && (!exact || index_of(*path.first) == indices[exact->surface]);
    // A wrong shadow or a wrong sphere in a mirror shows in the radiance.
    wrong += !is_first_right || error_of({seen.r, seen.g, seen.b}, radiance) > 1e-6;
    hits += exact.has_value();
    ++tried;
    compared.add({.origin = ray.origin, .direction = ray.direction}, region);
    alone.push_back(seen);
  }
  verdict.none_wrong("pixels", wrong, tried);
  // The fastest kernel follows many paths at a time.
  const std::vector<Rgb> together = seen_together(scene, compared.rays);
  verdict.require(together == alone, "same bits together");
  verdict.require(tried >= 1000 && hits > 100 && tried - hits > 20, std::to_string(hits) + " hits");
}

}  // namespace

BOOST_AUTO_TEST_SUITE(bulk_cases)

BOOST_AUTO_TEST_CASE(case_40_many_spheres) {
  Verdict verdict(40, "in memory, bounded depth, no wrong pixel of 1,000 against quad precision");
  check_bulk(verdict, "random", random_spheres(scaled_count(100000)));
  check_bulk(verdict, "one centre", one_center(scaled_count(10000)));
  check_bulk(verdict, "on a line", on_a_line(scaled_count(10000)));
  check_bulk(verdict, "radii 1e+-6", radii_over_decades(scaled_count(10000)));
}

BOOST_AUTO_TEST_SUITE_END()
