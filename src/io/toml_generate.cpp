// SPDX-License-Identifier: BSD-3-Clause
#include "io/toml_generate.h"

#include <cmath>

#include "io/generate.h"
#include "io/toml_materials.h"

namespace tessera::io {
namespace {

const TomlFields::Keys kFlakeKeys{"kind", "level", "center", "radius", "material", "materials"};
const TomlFields::Keys kCloudKeys{"kind", "count", "seed", "fill", "center", "scale", "material", "materials"};
const TomlFields::Keys kAllKeys{"kind", "level", "radius", "count",    "seed",
                                "fill", "scale", "center", "material", "materials"};

enum class Kind { sphereflake, cloud };

std::vector<render::MaterialIndex> read_material_names(const TomlFields& fields, MaterialSet& materials) {
  if (!fields.has("materials")) return {read_material_name(fields, "material", materials)};
  if (fields.has("material")) fields.refuse("materials", "materials and material exclude each other");
  std::vector<PlacedWord> names;
  fields.read("materials", names);
  std::vector<render::MaterialIndex> indices;
  for (const PlacedWord& name : names) indices.push_back(material_named(name, materials));
  return indices;
}

void check_positive(const TomlFields& fields, std::string_view key, double value) {
  if (!(value > 0)) fields.refuse_value(key, "> 0");
}

/// Refuses a size with which the farthest sphere would be out of range.
void check_reach(const TomlFields& fields, std::string_view key, double size, const render::Vec3& center) {
  const double reach = 4 * size + std::abs(center.x) + std::abs(center.y) + std::abs(center.z);
  if (!std::isfinite(reach)) fields.refuse(key, std::string(key) + " is too large");
}

std::vector<render::Sphere> read_flake(const TomlFields& fields, MaterialSet& materials) {
  fields.refuse_unknown_keys(kFlakeKeys, "[generate] with kind = \"sphereflake\"");
  Sphereflake flake;
  fields.read("level", flake.level);
  fields.read("center", flake.center);
  fields.read("radius", flake.radius);
  flake.materials = read_material_names(fields, materials);
  if (flake.level > Sphereflake::kMaxLevel) {
    fields.refuse_value("level",
                        "0 to " + std::to_string(Sphereflake::kMaxLevel) + ", each has nine times the spheres");
  }
  check_positive(fields, "radius", flake.radius);
  check_reach(fields, "radius", flake.radius, flake.center);
  return generate_sphereflake(flake);
}

std::vector<render::Sphere> read_cloud(const TomlFields& fields, MaterialSet& materials) {
  fields.refuse_unknown_keys(kCloudKeys, "[generate] with kind = \"cloud\"");
  Cloud cloud;
  fields.read("count", cloud.count);
  fields.read("seed", cloud.seed);
  fields.read("fill", cloud.fill);
  fields.read("center", cloud.center);
  fields.read("scale", cloud.scale);
  cloud.materials = read_material_names(fields, materials);
  if (cloud.count < 1 || cloud.count > Cloud::kMaxCount) {
    fields.refuse_value("count", "1 to " + std::to_string(Cloud::kMaxCount));
  }
  check_positive(fields, "scale", cloud.scale);
  check_positive(fields, "fill", cloud.fill);
  check_reach(fields, "scale", cloud.scale, cloud.center);
  check_reach(fields, "fill", cloud.fill * cloud.scale, cloud.center);
  return generate_cloud(cloud);
}

}  // namespace

std::vector<render::Sphere> generate_spheres(const TomlFields& file, MaterialSet& materials) {
  std::vector<render::Sphere> spheres;
  file.visit_table("generate", kAllKeys, [&](const TomlFields& fields) {
    Kind kind{};
    fields.require_key("kind");
    fields.read_choice<Kind>("kind", kind, {{"sphereflake", Kind::sphereflake}, {"cloud", Kind::cloud}});
    spheres = kind == Kind::cloud ? read_cloud(fields, materials) : read_flake(fields, materials);
  });
  return spheres;
}

}  // namespace tessera::io
