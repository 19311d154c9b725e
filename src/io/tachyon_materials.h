// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/tachyon_notes.h"
#include "io/tachyon_tokens.h"
#include "render/scene_data.h"

// The textures of a Tachyon scene under their names, equal materials shared: VMD writes one texture per sphere.
namespace tessera::io {

class TachyonMaterials {
 public:
  /// Reads the texture of a shape: a name, or TEXTURE and its body.
  /// throws:  Error(bad_scene)
  render::MaterialIndex read(TachyonTokens& in, TachyonNotes& notes);

  /// Reads what follows TEXDEF. Of several definitions of a name the first counts, as in Tachyon.
  /// throws:  Error(bad_scene)
  void read_definition(TachyonTokens& in, TachyonNotes& notes);

  /// Reads what follows TEXALIAS: the new name, then the old one.
  /// throws:  Error(bad_scene)
  void read_alias(TachyonTokens& in);

  std::vector<render::Material> take() { return std::move(materials_); }

 private:
  struct HashMaterial {
    std::size_t operator()(const render::Material& material) const noexcept;
  };
  struct HashName {
    using is_transparent = void;  // looks up a string_view without making a string
    std::size_t operator()(std::string_view name) const noexcept { return std::hash<std::string_view>{}(name); }
  };

  render::MaterialIndex named(std::string_view name, const TachyonTokens& in) const;
  render::MaterialIndex share(const render::Material& material);

  std::vector<render::Material> materials_;
  std::unordered_map<render::Material, render::MaterialIndex, HashMaterial> shared_;
  std::unordered_map<std::string, render::MaterialIndex, HashName, std::equal_to<>> names_;
};

}  // namespace tessera::io
