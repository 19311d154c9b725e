// SPDX-License-Identifier: BSD-3-Clause
#include "io/material_set.h"

#include <algorithm>
#include <cstdint>

#include "io/place.h"
#include "io/suggest.h"

namespace tessera::io {

using render::MaterialIndex;

MaterialIndex MaterialSet::append(const render::Material& material) {
  materials_.push_back(material);
  return static_cast<MaterialIndex>(materials_.size() - 1);
}

MaterialIndex MaterialSet::add(const std::string& name, const render::Material& material) {
  return names_[name] = append(material);
}

std::optional<MaterialIndex> MaterialSet::find(std::string_view name) const {
  const auto found = names_.find(name);
  if (found == names_.end()) return std::nullopt;
  return found->second;
}

std::string MaterialSet::unknown(std::string_view name) const {
  if (names_.empty()) return "unknown material " + in_quotes(name) + " (there is no [material.NAME] in the scene)";
  std::vector<std::string> names;
  for (const auto& [known, index] : names_) names.push_back(known);
  std::sort(names.begin(), names.end());
  return "unknown material " + in_quotes(name) + did_you_mean(name, names);
}

MaterialIndex MaterialSet::default_material() {
  if (!default_) default_ = append({});
  return *default_;
}

MaterialIndex MaterialSet::colored(MaterialIndex base, const render::Rgb& color) {
  if (color == (*this)[base].color) return base;
  const auto [variant, is_new] = variants_.try_emplace({base, color});
  if (is_new) {
    render::Material material = (*this)[base];
    material.color = color;
    variant->second = append(material);
  }
  return variant->second;
}

std::size_t MaterialSet::HashVariant::operator()(const Variant& variant) const noexcept {
  std::size_t hash = static_cast<std::size_t>(variant.base);
  for (const double channel : {variant.color.r, variant.color.g, variant.color.b}) {
    // std::hash gives 0.0 and -0.0, which are equal, the same value
    hash = (hash ^ std::hash<double>{}(channel)) * std::uint64_t{0x9e3779b97f4a7c15};
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace tessera::io
