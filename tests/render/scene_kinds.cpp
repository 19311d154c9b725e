// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene_kinds.h"

#include "render/scene_fixture.h"

namespace tessera::render::test {
namespace {

void put(SceneData& scene, const Vec3& center, double radius) {
  const std::size_t material = scene.spheres.size() % scene.materials.size();
  scene.spheres.push_back({center, radius, static_cast<MaterialIndex>(material)});
}

void apart(Random& random, SceneData& scene) {
  for (int i = 0; i != 60; ++i) put(scene, random.in_box(4), random.uniform(0.1, 0.5));
}

void overlapping(Random& random, SceneData& scene) {
  for (int i = 0; i != 40; ++i) put(scene, random.in_box(2), random.uniform(0.5, 1.5));
}

void nested(Random& random, SceneData& scene) {
  for (int i = 0; i != 12; ++i) put(scene, 0.02 * random.in_box(1), 0.2 * (i + 1));
  for (int i = 0; i != 8; ++i) put(scene, random.in_box(3), 0.3);
}

// A cubic lattice: every sphere touches its neighbours.
void tangent(Random& random, SceneData& scene) {
  for (int i = 0; i != 27; ++i) put(scene, {i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0}, 0.5);
  put(scene, {0, 0, 3.5 + random.uniform()}, 2);
}

void duplicates(Random& random, SceneData& scene) {
  for (int i = 0; i != 20; ++i) {
    const Vec3 center = random.in_box(2);
    for (int copy = 0; copy != 3; ++copy) put(scene, center, 0.5);
  }
}

void radii_over_decades(Random& random, SceneData& scene) {
  for (int i = 0; i != 80; ++i) put(scene, random.in_box(3), random.over_decades(1e-12, 1));
}

void on_a_line(Random& random, SceneData& scene) {
  for (int i = 0; i != 60; ++i) put(scene, {random.uniform(-4, 4), 0, 0}, random.uniform(0.01, 0.2));
}

void one_center(Random& random, SceneData& scene) {
  for (int i = 0; i != 60; ++i) put(scene, {0.25, 0.5, -0.125}, random.uniform(0.1, 1));
}

void far_away(Random& random, SceneData& scene) {
  for (int i = 0; i != 60; ++i) put(scene, Vec3{1e6, -1e6, 1e6} + random.in_box(3), random.uniform(0.1, 0.8));
}

void with_zero_radii(Random& random, SceneData& scene) {
  for (int i = 0; i != 40; ++i) put(scene, random.in_box(3), i % 2 == 0 ? 0 : random.uniform(0.2, 1));
}

void closed_room(Random& random, SceneData& scene) {
  put(scene, {0, 0, 0}, 9);
  put(scene, {0, 0, 0}, 10);
  for (int i = 0; i != 20; ++i) put(scene, random.in_box(4), random.uniform(0.2, 1));
}

}  // namespace

const std::vector<SceneKind>& scene_kinds() {
  static const std::vector<SceneKind> kinds{
      {"apart", 6, {}, apart},
      {"overlapping", 5, {}, overlapping},
      {"nested", 4, {}, nested},
      {"tangent", 3, {}, tangent},
      {"duplicates", 4, {}, duplicates},
      {"radii over decades", 5, {}, radii_over_decades},
      {"on a line", 5, {}, on_a_line},
      {"one center", 2, {0.25, 0.5, -0.125}, one_center},
      {"far away", 5, {1e6, -1e6, 1e6}, far_away},
      {"with zero radii", 5, {}, with_zero_radii},
      {"closed room", 5, {}, closed_room},
  };
  return kinds;
}

SceneData random_scene(const SceneKind& kind, std::uint64_t seed) {
  Random random(seed);
  SceneData scene;
  for (const double reflection : {0.0, 0.0, 0.4, 0.9, 0.0, 1.0}) {
    Material material;
    material.color = {random.uniform(), random.uniform(), random.uniform()};
    material.specular = random.flip() ? 0.5 : 0;
    material.shininess = random.over_decades(1, 100);
    material.reflection = reflection;
    add_material(scene, material);
  }
  kind.add_spheres(random, scene);
  add_point_light(scene, kind.center + 3 * kind.size * random.direction(), {0.6, 0.5, 0.4});
  add_point_light(scene, kind.center + 0.4 * kind.size * random.direction(), {0.3, 0.4, 0.5});
  add_directional_light(scene, random.direction(), {0.2, 0.3, 0.4});
  scene.environment.background = {0.1, 0.2, 0.3};
  if (seed % 2 == 1) {
    const Vec3 normal = random.direction();
    scene.planes.push_back(
        {kind.center - kind.size * normal, normal, MaterialIndex{0}, Checker{MaterialIndex{3}, 0.7}});
  }
  return scene;
}

}  // namespace tessera::render::test
