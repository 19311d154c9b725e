// SPDX-License-Identifier: BSD-3-Clause
#include "io/toml_materials.h"

#include "render/check.h"

namespace tessera::io {
namespace {

const TomlFields::Keys kMaterialKeys{"color", "ambient", "diffuse", "specular", "shininess", "reflection"};

render::Material read_material(const TomlFields& fields) {
  render::Material material;
  fields.read("color", material.color);
  fields.read("ambient", material.ambient);
  fields.read("diffuse", material.diffuse);
  fields.read("specular", material.specular);
  fields.read("shininess", material.shininess);
  fields.read("reflection", material.reflection);
  fields.check(problem_with(material));
  return material;
}

}  // namespace

void read_materials(const TomlFields& file, MaterialSet& materials) {
  file.visit_named_tables("material", kMaterialKeys, [&](const std::string& name, const TomlFields& fields) {
    materials.add(name, read_material(fields));
  });
}

render::MaterialIndex material_named(const PlacedWord& name, const MaterialSet& materials) {
  const auto material = materials.find(name.text);
  if (!material) refuse(name.place, materials.unknown(name.text));
  return *material;
}

render::MaterialIndex read_material_name(const TomlFields& fields, std::string_view key, MaterialSet& materials) {
  if (!fields.has(key)) return materials.default_material();
  PlacedWord name;
  fields.read(key, name);
  return material_named(name, materials);
}

}  // namespace tessera::io
