// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/scene_data.h"

namespace tessera::io {

/// Which materials of a scene get a name in a file, and which are a named one in another colour: a table of spheres
/// may have a colour in each row, and a million names would take long to read.
class MaterialNames {
 public:
  enum class Variants {
    named,        ///< every material has its own name
    colored_rows  ///< of those that differ in colour alone only the first does, and those of planes
  };
  MaterialNames(const render::SceneData& scene, Variants variants);

  bool has_name(render::MaterialIndex index) const { return base_of(index) == index; }
  /// The named material that this one is, or is in another colour.
  render::MaterialIndex base_of(render::MaterialIndex index) const { return bases_[position_of(index)]; }
  /// Its base's name. Names sort as the materials do: that is the order in which they are read.
  const std::string& name_of(render::MaterialIndex index) const { return names_[position_of(base_of(index))]; }

 private:
  static std::size_t position_of(render::MaterialIndex index) { return static_cast<std::size_t>(index); }

  std::vector<render::MaterialIndex> bases_;
  std::vector<std::string> names_;
};

}  // namespace tessera::io
