// SPDX-License-Identifier: BSD-3-Clause
#include "io/toml_scene.h"

#include <utility>

#include "io/error.h"
#include "io/material_set.h"
#include "io/read_file.h"
#include "io/sphere_table.h"
#include "io/toml_fields.h"
#include "io/toml_generate.h"
#include "io/toml_materials.h"
#include "render/check.h"

namespace tessera::io {
namespace {

using render::problem_with;

const TomlFields::Keys kSceneKeys{"format",   "image",  "camera", "environment", "light",
                                  "material", "sphere", "plane",  "spheres",     "generate"};
const TomlFields::Keys kImageKeys{"width", "height", "samples", "max_bounces", "transfer", "shade"};
const TomlFields::Keys kCameraKeys{"eye", "target", "up", "fov", "height", "handedness"};
const TomlFields::Keys kEnvironmentKeys{"ambient", "background"};
const TomlFields::Keys kLightKeys{"position", "direction", "color", "intensity"};
const TomlFields::Keys kSphereKeys{"center", "radius", "material"};
const TomlFields::Keys kPlaneKeys{"point", "normal", "material", "checker_material", "checker_size"};
const TomlFields::Keys kTableKeys{"file", "material", "columns"};

toml::table parse_toml(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string text = read_file(path);
  try {
    toml::table table = toml::parse(std::string_view(text), std::string_view(file));
    if (table.empty()) throw Error(ErrorKind::bad_scene, file + ": the scene file is empty");
    return table;
  } catch (const toml::parse_error& error) {
    const auto begin = error.source().begin;
    refuse({file, begin.line, begin.column}, std::string(error.description()));
  }
}

void check_format(const TomlFields& file) {
  std::uint32_t format = 1;
  file.read("format", format);
  if (format != 1) file.refuse_value("format", "1");
}

void read_image(const TomlFields& fields, render::ImageSettings& image) {
  fields.read("width", image.width);
  fields.read("height", image.height);
  fields.read("samples", image.samples);
  fields.read("max_bounces", image.max_bounces);
  fields.read_choice<render::Transfer>("transfer", image.transfer,
                                       {{"srgb", render::Transfer::srgb}, {"none", render::Transfer::none}});
  fields.read_choice<render::Shade>("shade", image.shade,
                                    {{"phong", render::Shade::phong}, {"blinn", render::Shade::blinn}});
  fields.check(problem_with(image));
}

render::Camera read_camera(const TomlFields& fields) {
  render::Camera camera;
  fields.require("eye", camera.eye);
  fields.require("target", camera.target);
  fields.read("up", camera.up);
  if (fields.has("height")) {
    if (fields.has("fov")) fields.refuse("height", "height and fov exclude each other (height is for orthographic)");
    camera.projection = render::Projection::orthographic;
  }
  fields.read("fov", camera.fov);
  fields.read("height", camera.height);
  fields.read_choice<render::Handedness>("handedness", camera.handedness,
                                         {{"right", render::Handedness::right}, {"left", render::Handedness::left}});
  fields.check(problem_with(camera));
  return camera;
}

void read_environment(const TomlFields& fields, render::Environment& environment) {
  fields.read("ambient", environment.ambient);
  fields.read("background", environment.background);
  fields.check(problem_with(environment));
}

render::Light read_light(const TomlFields& fields) {
  render::Light light;
  if (fields.has("direction")) {
    if (fields.has("position")) fields.refuse("direction", "direction and position exclude each other");
    light.kind = render::LightKind::directional;
    fields.read("direction", light.vector);
  } else {
    if (!fields.has("position")) fields.refuse("position", "missing key \"position\" or \"direction\" in [[light]]");
    fields.read("position", light.vector);
  }

  double intensity = 1;
  fields.read("color", light.color);
  fields.read("intensity", intensity);
  fields.check(problem_with(light));
  if (intensity < 0) fields.refuse_value("intensity", ">= 0");
  light.color = light.color * intensity;
  if (problem_with(light)) fields.refuse("intensity", "intensity times color is out of range");
  return light;
}

render::Sphere read_sphere(const TomlFields& fields, MaterialSet& materials) {
  render::Sphere sphere;
  fields.require("center", sphere.center);
  fields.require("radius", sphere.radius);
  sphere.material = read_material_name(fields, "material", materials);
  fields.check(problem_with(sphere));
  return sphere;
}

render::Plane read_plane(const TomlFields& fields, MaterialSet& materials) {
  render::Plane plane;
  fields.require("point", plane.point);
  fields.require("normal", plane.normal);
  plane.material = read_material_name(fields, "material", materials);
  if (fields.has("checker_material")) {
    plane.checker.emplace().material = read_material_name(fields, "checker_material", materials);
    fields.read("checker_size", plane.checker->size);
  } else if (fields.has("checker_size")) {
    fields.refuse("checker_size", "checker_size needs a checker_material");
  }
  fields.check(problem_with(plane));
  return plane;
}

SphereTable read_table(const TomlFields& fields, const std::filesystem::path& folder, MaterialSet& materials) {
  PlacedWord file;
  SphereTableOptions options;
  fields.require("file", file);
  fields.read("columns", options.columns);
  if (fields.has("material")) options.material = read_material_name(fields, "material", materials);
  try {
    return read_sphere_table(folder / file.text, options, materials);
  } catch (const Error& error) {
    // What is wrong inside the file has its own place
    if (error.kind() == ErrorKind::bad_scene) throw;
    throw Error(error.kind(), text_of(file.place) + error.what());
  }
}

void append(std::vector<render::Sphere>& spheres, std::vector<render::Sphere> more) {
  if (spheres.empty()) {
    spheres = std::move(more);
  } else {
    spheres.insert(spheres.end(), more.begin(), more.end());
  }
}

}  // namespace

ReadScene read_toml_scene(const std::filesystem::path& path) {
  const std::string name = path.string();
  const toml::table table = parse_toml(path);
  const TomlFields file(name, table, "the scene file", kSceneKeys);
  check_format(file);

  ReadScene read;
  render::SceneData& scene = read.scene;
  MaterialSet materials;
  using Fields = const TomlFields&;
  file.visit_table("image", kImageKeys, [&](Fields image) { read_image(image, scene.image); });
  file.visit_table("camera", kCameraKeys, [&](Fields camera) { scene.camera = read_camera(camera); });
  file.visit_table("environment", kEnvironmentKeys,
                   [&](Fields fields) { read_environment(fields, scene.environment); });
  file.visit_tables("light", kLightKeys, [&](Fields light) { scene.lights.push_back(read_light(light)); });
  read_materials(file, materials);
  file.visit_tables("sphere", kSphereKeys,
                    [&](Fields sphere) { scene.spheres.push_back(read_sphere(sphere, materials)); });
  file.visit_tables("plane", kPlaneKeys, [&](Fields plane) { scene.planes.push_back(read_plane(plane, materials)); });
  file.visit_tables("spheres", kTableKeys, [&](Fields fields) {
    SphereTable spheres = read_table(fields, path.parent_path(), materials);
    append(scene.spheres, std::move(spheres.spheres));
    read.notes.insert(read.notes.end(), spheres.notes.begin(), spheres.notes.end());
  });
  append(scene.spheres, generate_spheres(file, materials));
  scene.materials = materials.take();
  return read;
}

}  // namespace tessera::io
