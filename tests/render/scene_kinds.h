// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/random.h"
#include "render/scene_data.h"

// Random scenes of every kind that has ever broken a tree: the input of the property tests.
namespace tessera::render::test {

struct SceneKind {
  std::string name;
  double size;  ///< half the side of a box around most of the scene, about `center`
  Vec3 center;
  std::function<void(Random&, SceneData&)> add_spheres;
};

const std::vector<SceneKind>& scene_kinds();

/// Spheres of that kind with a few materials, some of them mirrors, three lights, and, every other seed, a floor.
SceneData random_scene(const SceneKind& kind, std::uint64_t seed);

}  // namespace tessera::render::test
