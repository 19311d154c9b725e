// SPDX-License-Identifier: BSD-3-Clause
// What cells promise: the answers of brute force, within their room, and most of the answers of an ordinary scene.
#include "render/light_cells.h"

#include <string>

#include "render/light_cells_check.h"

using namespace tessera::render;
using namespace tessera::render::test;

BOOST_AUTO_TEST_SUITE(light_cells)

BOOST_AUTO_TEST_CASE(shadows_are_those_of_brute_force_in_every_kind_of_scene) {
  for (const SceneKind& kind : scene_kinds()) {
    for (const std::uint64_t seed : {135U, 136U}) {
      SceneData data = random_scene(kind, seed);
      add_point_light(data, data.spheres[1].center);
      add_point_light(data, data.spheres[2].center + Vec3{data.spheres[2].radius, 0, 0});
      CellsCheck check(kind.name, data);
      check.look_from_box(kind.center, 2 * kind.size, 24, 500);
      check.ask_all();
    }
  }
}

BOOST_AUTO_TEST_CASE(cells_decide_most_rays_of_ordinary_scenes) {
  for (const int count : {30, 3000}) {
    SceneData data = count == 30 ? cloud(30, 0.1, 0.4) : cloud(3000, 0.005, 0.05);
    add_plane(data, {0, 0, -1}, {0, 0, 1});
    add_lights(data);
    CellsCheck check("cloud of " + std::to_string(count), data);
    Random random(145);
    for (int i = 0; i != 4; ++i) {
      check.points().see(check.scene(), random.in_box(2) + Vec3{0, 0, 3}, random.in_box(0.5), 0.1, 2000, random);
    }
    const LightCells::Counts counts = check.ask_all();
    if (!has_cells()) continue;
    BOOST_TEST(counts.decided > counts.left, count << " spheres");
    BOOST_TEST(counts.made > 100U, count << " spheres");
  }
}

BOOST_AUTO_TEST_CASE(cells_with_too_many_spheres_are_divided) {
  SceneData data = cloud(10, 0.01, 0.1);
  Random random(146);
  for (int i = 0; i != 2000; ++i) put(data, random.in_box(0.1), random.over_decades(2e-4, 2e-3));
  add_lights(data);
  CellsCheck check("dust", data);
  for (int i = 0; i != 8; ++i) check.points().see(check.scene(), random.direction(), {0, 0, 0}, 0.1, 500, random);
  const LightCells::Counts counts = check.ask_all();
  if (!has_cells()) return;
  BOOST_TEST(counts.decided > counts.left);
  BOOST_TEST(counts.divided > 10U);
}

BOOST_AUTO_TEST_CASE(other_kernels_have_no_cells) {
  SceneData data = cloud(30, 0.1, 0.4);
  add_lights(data);
  for (const Kernel kernel : {Kernel::scalar, Kernel::brute}) {
    CellsCheck check("no cells", data, kernel);
    check.look_from_box({0, 0, 1}, 2, 8, 500);
    const LightCells::Counts counts = check.ask_all();
    BOOST_TEST(counts.decided == 0U);
    BOOST_TEST(counts.made == 0U);
  }
}

// A tree without a node, and a scene without anything.
BOOST_AUTO_TEST_CASE(scenes_without_spheres_are_lit) {
  for (int i = 0; i != 2; ++i) {
    SceneData data = with_materials();
    if (i == 1) put(data, {0, 0, 1}, 0);
    add_plane(data, {0, 0, -1}, {0, 0, 1});
    add_lights(data);
    CellsCheck check("plane", data);
    Random random(137);
    check.points().see(check.scene(), {0, 0, 1}, {0, 0, -1}, 0.5, 3000, random);
    check.ask_all();
  }
}

BOOST_AUTO_TEST_CASE(little_memory_changes_no_answer) {
  SceneData data = cloud(3000, 0.005, 0.05);
  add_lights(data);
  CellsCheck check("little memory", data);
  check.look_from_box({0, 0, 1}, 2, 10, 1000);
  for (const std::size_t bytes :
       {std::size_t{0}, std::size_t{1000}, std::size_t{4096 * 32}, std::size_t{200'000}, std::size_t{250'000}}) {
    for (const std::size_t light : {0U, 2U, 3U}) {
      const auto counts = check.ask(light, bytes);
      BOOST_TEST(counts.made * sizeof(TreeLeaf) <= bytes + 4 * sizeof(TreeLeaf));
      if (bytes <= 4096 * 32) BOOST_TEST(counts.made == 0U);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
