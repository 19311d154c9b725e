// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "render/scene_data.h"

// The materials of a scene while it is read: those with a name, the default one, and coloured variants of both.
namespace tessera::io {

class MaterialSet {
 public:
  render::MaterialIndex add(const std::string& name, const render::Material& material);

  /// The material of that name, or nullopt; unknown() then says what is wrong.
  std::optional<render::MaterialIndex> find(std::string_view name) const;
  std::string unknown(std::string_view name) const;

  /// The grey material of things that name none. It joins the set when it is first asked for.
  render::MaterialIndex default_material();

  /// `base` in another colour. Equal pairs share one material.
  render::MaterialIndex colored(render::MaterialIndex base, const render::Rgb& color);

  const render::Material& operator[](render::MaterialIndex index) const {
    return materials_[static_cast<std::size_t>(index)];
  }
  std::size_t size() const noexcept { return materials_.size(); }
  std::vector<render::Material> take() { return std::move(materials_); }

 private:
  struct Variant {
    render::MaterialIndex base;
    render::Rgb color;
    friend bool operator==(const Variant&, const Variant&) = default;
  };
  struct HashVariant {
    std::size_t operator()(const Variant& variant) const noexcept;
  };
  struct HashName {
    using is_transparent = void;  // looks up a string_view without making a string
    std::size_t operator()(std::string_view name) const noexcept { return std::hash<std::string_view>{}(name); }
  };

  render::MaterialIndex append(const render::Material& material);

  std::vector<render::Material> materials_;
  std::unordered_map<std::string, render::MaterialIndex, HashName, std::equal_to<>> names_;
  std::unordered_map<Variant, render::MaterialIndex, HashVariant> variants_;
  std::optional<render::MaterialIndex> default_;
};

}  // namespace tessera::io
