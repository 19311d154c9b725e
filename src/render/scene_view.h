// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "render/scene_data.h"

namespace tessera::render {

/// A whole scene to look at, whoever holds its parts.
struct SceneView {
  SceneView(const SceneData& scene) noexcept : SceneView(scene.spheres, scene.materials, scene) {}
  SceneView(std::span<const Sphere> all_spheres, std::span<const Material> all_materials, const Stage& rest) noexcept
      : spheres(all_spheres), materials(all_materials), stage(rest) {}

  std::span<const Sphere> spheres;
  std::span<const Material> materials;
  const Stage& stage;
};

}  // namespace tessera::render
