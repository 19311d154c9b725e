// SPDX-License-Identifier: BSD-3-Clause
// The boxes of the tree, away from the origin of the coordinates where they round most.
#include "render/camera_paths.h"
#include "render/kernels.h"
#include "stress/stress_scene.h"

using namespace tessera::stress;

namespace {

/// Spheres of many sizes around `offset`, on a grid and off it, with mirrors, a floor and two lights.
SceneData scattered(Random& random, double offset) {
  SceneData data;
  const Vec3 shift{offset, -offset, offset};
  for (int i = 0; i != 200; ++i) {
    Material material{.color = {0.9, 0.5, 0.3 + 0.003 * i}, .specular = 0.4, .shininess = 20};
    material.reflection = i % 3 == 0 ? 0.5 : 0;
    const Vec3 place = random.in_box(4);
    const Vec3 on_grid{std::floor(place.x), std::floor(place.y), std::floor(place.z)};
    add_sphere(data, shift + (i % 2 == 0 ? place : on_grid), i % 2 == 0 ? random.over_decades(1e-4, 0.5) : 0.5,
               material);
  }
  add_plane(data, shift + Vec3{0, 0, -5}, {0, 0, 1});
  add_point_light(data, shift + Vec3{4, -5, 6}, {0.7, 0.7, 0.7});
  add_directional_light(data, {0, 1, -1}, {0.2, 0.2, 0.2});
  data.environment.background = {0.1, 0.2, 0.4};
  data.image.max_bounces = 4;
  return data;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(node_cases)

// The matrix sets float nodes against double nodes. Here the tree, whatever its nodes are stored as, is set against no
// nodes at all, which no rounding of a box can mislead: the stronger oracle for both.
BOOST_AUTO_TEST_CASE(case_42_nodes_against_none_at_offsets) {
  Verdict verdict(42, "same bits as without nodes, at offsets 0, 1e2 and 1e6");
  Random random(42);
  for (const double offset : {0.0, 1e2, 1e6}) {
    std::size_t off = 0;
    std::size_t tried = 0;
    std::size_t mirrored = 0;
    for (int scene_number = 0; scene_number != 4; ++scene_number) {
      const SceneData data = scattered(random, offset);
      const Scene tree = prepared(data);
      const Scene brute = prepared(data, Kernel::brute);
      CameraPaths paths;
      std::vector<Rgb> alone;
      for (int i = 0; i != 1500; ++i) {
        const Sphere& aim = tree.sphere(surface_id(random.below(200)));
        // At its outline, or along an axis and an edge of its box.
        const auto side = [&] { return (static_cast<double>(random.below(3)) - 1) * aim.radius; };
        const double zero = random.flip() ? 0.0 : -0.0;
        const Vec3 axes[] = {{1, zero, zero}, {zero, -1, zero}, {-zero, zero, 1}, {1, 1, zero}, {1, -1, 1}};
        const bool is_skew = random.flip();
        const Vec3 direction = is_skew ? random.direction() : axes[random.below(5)];
        const Vec3 across = is_skew ? aim.radius * random.perpendicular_to(direction) : Vec3{side(), side(), side()};
        const Vec3 eye = aim.center + across - 24 * aim.radius * direction;
        RayCounts with;
        RayCounts without;
        const Rgb a = seen_from(tree, eye, direction, with);
        const Rgb b = seen_from(brute, eye, direction, without);
        ++tried;
        off += !(a == b && with == without);
        mirrored += with.mirror > 0;
        paths.add(brute, eye, direction);
        alone.push_back(b);
      }
      for (const NamedKernel& named : supported_kernels()) {
        const std::vector<Rgb> together = seen_together(prepared(data, named.kernel), paths.rays);
        for (std::size_t i = 0; i != alone.size(); ++i) off += together[i] != alone[i];
        tried += alone.size();
      }
    }
    verdict.none_wrong("paths at " + std::to_string(static_cast<int>(offset)), off, tried);
    BOOST_TEST(mirrored > tried / 40);
  }
}

BOOST_AUTO_TEST_SUITE_END()
