// SPDX-License-Identifier: BSD-3-Clause
#include "io/material_names.h"

#include <array>
#include <map>

namespace tessera::io {

using render::MaterialIndex;

MaterialNames::MaterialNames(const render::SceneData& scene, Variants variants) {
  const std::size_t count = scene.materials.size();
  const std::size_t digits = std::to_string(count).size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    std::string& name = names_.emplace_back(1 + digits - number.size(), '0');
    name.front() = 'm';
    name += number;
    bases_.push_back(static_cast<MaterialIndex>(i));
  }
  if (variants == Variants::named) return;

  std::map<std::array<double, 5>, MaterialIndex> first_of_weights;
  for (std::size_t i = 0; i < count; ++i) {
    const render::Material& m = scene.materials[i];
    const std::array weights{m.ambient, m.diffuse, m.specular, m.shininess, m.reflection};
    bases_[i] = first_of_weights.try_emplace(weights, bases_[i]).first->second;
  }
  const auto give_name = [this](MaterialIndex index) { bases_[position_of(index)] = index; };
  for (const render::Plane& plane : scene.planes) {
    give_name(plane.material);
    if (plane.checker) give_name(plane.checker->material);
  }
}

}  // namespace tessera::io
