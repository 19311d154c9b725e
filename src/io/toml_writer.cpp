// SPDX-License-Identifier: BSD-3-Clause
#include "io/toml_writer.h"

#include <cstddef>
#include <cstdio>

#include "io/material_names.h"
#include "io/text_builder.h"

namespace tessera::io {
namespace {

using render::MaterialIndex;
using render::SceneData;

constexpr TripleStyle kStyle{"[", ", ", "]"};
constexpr TripleStyle kRowStyle{"", " ", ""};
constexpr std::size_t kMostSpheres = 300;  // without a table
constexpr std::size_t kMostNames = 300;    // with one

/// A string as TOML quotes it.
std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') result += '\\';
    if (code >= 0x20 && code != 0x7f) {
      result += c;
    } else {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(code));
      result += escape;
    }
  }
  return result + '"';
}

void write_image(TextBuilder& out, const render::ImageSettings& image) {
  out << "format = 1\n\n[image]\nwidth = " << std::uint64_t{image.width} << "\nheight = " << std::uint64_t{image.height}
      << "\nsamples = " << std::uint64_t{image.samples} << "\nmax_bounces = " << std::uint64_t{image.max_bounces}
      << "\ntransfer = " << (image.transfer == render::Transfer::srgb ? "\"srgb\"" : "\"none\"")
      << "\nshade = " << (image.shade == render::Shade::phong ? "\"phong\"" : "\"blinn\"") << "\n";
}

void write_camera(TextBuilder& out, const render::Camera& camera) {
  out << "\n[camera]\neye = " << camera.eye << "\ntarget = " << camera.target << "\nup = " << camera.up;
  if (camera.projection == render::Projection::perspective) {
    out << "\nfov = " << camera.fov;
  } else {
    out << "\nheight = " << camera.height;
  }
  if (camera.handedness == render::Handedness::left) out << "\nhandedness = \"left\"";
  out << "\n";
}

void write_light(TextBuilder& out, const render::Light& light) {
  out << "\n[[light]]\n"
      << (light.kind == render::LightKind::point ? "position" : "direction") << " = " << light.vector
      << "\ncolor = " << light.color << "\n";
}

void write_material(TextBuilder& out, const std::string& name, const render::Material& material) {
  out << "\n[material." << name << "]\ncolor = " << material.color << "\nambient = " << material.ambient
      << "\ndiffuse = " << material.diffuse << "\nspecular = " << material.specular
      << "\nshininess = " << material.shininess << "\nreflection = " << material.reflection << "\n";
}

void write_plane(TextBuilder& out, const render::Plane& plane, const MaterialNames& names) {
  out << "\n[[plane]]\npoint = " << plane.point << "\nnormal = " << plane.normal << "\nmaterial = \""
      << names.name_of(plane.material) << "\"\n";
  if (!plane.checker) return;
  out << "checker_material = \"" << names.name_of(plane.checker->material)
      << "\"\nchecker_size = " << plane.checker->size << "\n";
}

void write_sphere(TextBuilder& out, const render::Sphere& sphere, const MaterialNames& names) {
  out << "\n[[sphere]]\ncenter = " << sphere.center << "\nradius = " << sphere.radius << "\nmaterial = \""
      << names.name_of(sphere.material) << "\"\n";
}

/// `x y z r [r g b] material`
std::string table_of(const SceneData& scene, const MaterialNames& names) {
  constexpr std::size_t kBytesPerSphere = 90;
  TextBuilder out(kRowStyle);
  out.reserve(scene.spheres.size() * kBytesPerSphere);
  for (const render::Sphere& sphere : scene.spheres) {
    out << sphere.center << " " << sphere.radius << " ";
    if (!names.has_name(sphere.material)) {
      out << scene.materials[static_cast<std::size_t>(sphere.material)].color << " ";
    }
    out << names.name_of(sphere.material) << "\n";
  }
  return out.take();
}

}  // namespace

WrittenScene write_toml(const SceneData& scene, const std::string& table_name) {
  const bool has_table = scene.spheres.size() > kMostSpheres;
  const bool has_colors = has_table && scene.materials.size() > kMostNames;
  const MaterialNames names(scene, has_colors ? MaterialNames::Variants::colored_rows : MaterialNames::Variants::named);

  TextBuilder out(kStyle);
  write_image(out, scene.image);
  if (scene.camera) write_camera(out, *scene.camera);
  out << "\n[environment]\nambient = " << scene.environment.ambient << "\nbackground = " << scene.environment.background
      << "\n";
  for (const render::Light& light : scene.lights) write_light(out, light);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const auto index = static_cast<MaterialIndex>(i);
    if (names.has_name(index)) write_material(out, names.name_of(index), scene.materials[i]);
  }
  for (const render::Plane& plane : scene.planes) write_plane(out, plane, names);

  WrittenScene written;
  if (has_table) {
    out << "\n[[spheres]]\nfile = " << quoted(table_name) << "\n";
    written.sphere_table = table_of(scene, names);
    written.notes.push_back("the " + std::to_string(scene.spheres.size()) + " spheres are in " + table_name);
  } else {
    for (const render::Sphere& sphere : scene.spheres) write_sphere(out, sphere, names);
  }
  written.text = out.take();
  return written;
}

}  // namespace tessera::io
