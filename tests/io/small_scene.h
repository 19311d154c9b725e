// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/scene_data.h"

// A scene with one of everything that a file can say, for the tests of the writers.
namespace tessera::io::test {

inline render::SceneData small_scene() {
  using namespace render;
  SceneData scene;
  Material mirror{{0.5, 0.25, 0.125}, 0.2, 0.8, 0.4, 20, 0.5};
  Material matte{{1, 0, 0}, 0.1, 0.9, 0, 32, 0};
  scene.materials = {mirror, matte};
  scene.spheres = {{{1, 2, 3}, 0.5, MaterialIndex{0}}, {{-1.25, 1e-9, 1e22}, 2, MaterialIndex{1}}};
  scene.planes = {{{0, 0, -2}, {0, 0, 2}, MaterialIndex{1}, {}},
                  {{0, 0, 7}, {0, 4, 0}, MaterialIndex{0}, Checker{MaterialIndex{1}, 0.5}}};
  scene.lights = {{LightKind::point, {4, 3, 2}, {1, 0.5, 0}}, {LightKind::directional, {0, 0, -2}, {0.25, 0.25, 0.25}}};
  scene.camera = Camera{{0, -4, 0}, {0, 0, 0}, {0, 0, 1}, Projection::orthographic, 45, 2, Handedness::right};
  scene.environment = {{0.5, 0.5, 0.5}, {0, 0, 0.25}};
  scene.image = {200, 100, 1, 3, Transfer::none, Shade::phong};
  return scene;
}

/// The material of a thing.
inline const render::Material& material_of(const render::SceneData& scene, render::MaterialIndex index) {
  return scene.materials.at(static_cast<std::size_t>(index));
}

}  // namespace tessera::io::test
