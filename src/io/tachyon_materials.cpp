// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_materials.h"

#include <algorithm>
#include <cstdint>

#include "io/suggest.h"
#include "io/tachyon_texture.h"

namespace tessera::io {

using render::MaterialIndex;

MaterialIndex TachyonMaterials::read(TachyonTokens& in, TachyonNotes& notes) {
  const std::string_view word = in.word("a texture");
  if (!is_keyword(word, "TEXTURE")) return named(word, in);
  const TachyonTexture texture = read_texture_body(in);
  notes.count(texture.inexact);
  return share(texture.material);
}

void TachyonMaterials::read_definition(TachyonTokens& in, TachyonNotes& notes) {
  const std::string_view name = in.word("a texture's name");
  const TachyonTexture texture = read_texture_body(in);
  notes.count(texture.inexact);
  names_.try_emplace(std::string(name), share(texture.material));
}

void TachyonMaterials::read_alias(TachyonTokens& in) {
  const std::string_view alias = in.word("a texture's new name");
  const std::string_view name = in.word("a texture's name");
  names_.try_emplace(std::string(alias), named(name, in));
}

MaterialIndex TachyonMaterials::named(std::string_view name, const TachyonTokens& in) const {
  const auto found = names_.find(name);
  if (found == names_.end()) {
    std::vector<std::string> known;
    for (const auto& [other, index] : names_) known.push_back(other);
    std::sort(known.begin(), known.end());
    const std::string hint = did_you_mean(name, known);
    in.fail("unknown texture " + in_quotes(name) + (hint.empty() ? " (no TEXDEF of that name before)" : hint));
  }
  return found->second;
}

MaterialIndex TachyonMaterials::share(const render::Material& material) {
  const auto [entry, is_new] = shared_.try_emplace(material, static_cast<MaterialIndex>(materials_.size()));
  if (is_new) materials_.push_back(material);
  return entry->second;
}

std::size_t TachyonMaterials::HashMaterial::operator()(const render::Material& m) const noexcept {
  std::size_t hash = 0;
  for (const double part :
       {m.color.r, m.color.g, m.color.b, m.ambient, m.diffuse, m.specular, m.shininess, m.reflection}) {
    // std::hash gives 0.0 and -0.0, which are equal, the same value
    hash = (hash ^ std::hash<double>{}(part)) * std::uint64_t{0x9e3779b97f4a7c15};
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace tessera::io
