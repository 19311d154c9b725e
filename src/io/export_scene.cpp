// SPDX-License-Identifier: BSD-3-Clause
#include "io/export_scene.h"

#include <algorithm>

namespace tessera::io {

using render::Material;

Material with_added_mirror(Material material) {
  const double share = 1 - material.reflection;
  material.ambient *= share;
  material.diffuse *= share;
  material.specular *= share;
  return material;
}

std::string counted(std::size_t n, std::string_view one, std::string_view many) {
  return std::to_string(n) + " " + std::string(n == 1 ? one : many);
}

bool shows_cut_paths(const render::SceneData& scene) {
  return scene.environment.background != render::Rgb{} &&
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return m.reflection > 0; });
}

std::vector<std::string> common_notes(const render::SceneData& scene) {
  std::vector<std::string> notes;
  const auto points = std::count_if(scene.spheres.begin(), scene.spheres.end(),
                                    [](const render::Sphere& sphere) { return sphere.radius == 0; });
  if (points > 0) {
    notes.push_back("left out: " + counted(static_cast<std::size_t>(points), "sphere of radius 0, which is never seen",
                                           "spheres of radius 0, which are never seen"));
  }
  const auto covered = std::count_if(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
    return m.reflection == 1 && (m.ambient > 0 || m.diffuse > 0 || m.specular > 0);
  });
  if (covered > 0) {
    notes.push_back(
        "without ambient, diffuse and specular, of which nothing is seen: " +
        counted(static_cast<std::size_t>(covered), "material with reflection 1", "materials with reflection 1"));
  }
  if (scene.image.samples > 1) {
    notes.push_back("not said: " + std::to_string(scene.image.samples) + " samples per pixel");
  }
  return notes;
}

}  // namespace tessera::io
