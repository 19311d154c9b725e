// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_writer.h"

#include <algorithm>
#include <cstddef>

#include "io/export_scene.h"
#include "io/text_builder.h"
#include "render/power.h"

namespace tessera::io {
namespace {

using render::MaterialIndex;
using render::SceneData;

constexpr TripleStyle kStyle{"", " ", ""};

/// The part of ambient light that a weight can take over.
double grey_ambient(const render::Rgb& ambient) {
  return ambient.r == ambient.g && ambient.g == ambient.b ? ambient.r : (ambient.r + ambient.g + ambient.b) / 3;
}

void write_heading(TextBuilder& out, const SceneData& scene) {
  const auto& [width, height, samples, max_bounces, transfer, shade] = scene.image;
  const std::string_view shading = shade == render::Shade::phong ? "-shade_phong" : "-shade_blinn";
  out << "# tachyon FILE -fullshade " << shading << " -numthreads 1 -format PPM -o out.ppm\n"
      << "BEGIN_SCENE\nRESOLUTION " << std::uint64_t{width} << " " << std::uint64_t{height} << "\n";
}

void write_camera(TextBuilder& out, const SceneData& scene) {
  const render::Camera& camera = *scene.camera;
  const bool is_flat = camera.projection == render::Projection::orthographic;
  out << "CAMERA PROJECTION " << (is_flat ? "ORTHOGRAPHIC" : "PERSPECTIVE") << "\n  ZOOM "
      << (is_flat ? 1 / camera.height : 0.5 / render::tangent_of_degrees(camera.fov / 2))
      << " ASPECTRATIO 1.0 ANTIALIASING 0 RAYDEPTH " << std::uint64_t{scene.image.max_bounces} + 1 << "\n  CENTER "
      << camera.eye << " VIEWDIR " << camera.target - camera.eye << " UPDIR " << camera.up << "\nEND_CAMERA\n"
      << "BACKGROUND " << scene.environment.background << "\n";
}

void write_light(TextBuilder& out, const render::Light& light) {
  if (light.kind == render::LightKind::point) {
    out << "LIGHT CENTER " << light.vector << " RAD 0.0";
  } else {
    out << "DIRECTIONAL_LIGHT DIRECTION " << light.vector;
  }
  out << " COLOR " << light.color << "\n";
}

TextBuilder& operator<<(TextBuilder& out, MaterialIndex index) {
  return out << "m" << static_cast<std::uint64_t>(index);
}

void write_materials(TextBuilder& out, const SceneData& scene) {
  const double ambient = grey_ambient(scene.environment.ambient);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const render::Material material = with_added_mirror(scene.materials[i]);
    out << "TEXDEF " << static_cast<MaterialIndex>(i) << " AMBIENT " << ambient * material.ambient << " DIFFUSE "
        << material.diffuse << " SPECULAR " << material.reflection << " OPACITY 1.0 PHONG PLASTIC " << material.specular
        << " PHONG_SIZE " << material.shininess << " COLOR " << material.color << " TEXFUNC 0\n";
  }
}

void write_shapes(TextBuilder& out, const SceneData& scene) {
  for (const render::Plane& plane : scene.planes) {
    out << "PLANE CENTER " << plane.point << " NORMAL " << plane.normal << " " << plane.material << "\n";
  }
  for (const render::Sphere& sphere : scene.spheres) {
    if (sphere.radius == 0) continue;
    out << "SPHERE CENTER " << sphere.center << " RAD " << sphere.radius << " " << sphere.material << "\n";
  }
}

std::vector<std::string> notes_for(const SceneData& scene) {
  std::vector<std::string> notes;
  if (scene.camera->handedness == render::Handedness::right) {
    notes.push_back("Tachyon's picture will be the mirror image (it is left-handed)");
  }
  const auto boards = std::count_if(scene.planes.begin(), scene.planes.end(),
                                    [](const render::Plane& plane) { return plane.checker.has_value(); });
  if (boards > 0) {
    notes.push_back("drawn in the material of the even cells: " +
                    counted(static_cast<std::size_t>(boards), "checker board", "checker boards"));
  }
  const render::Rgb& ambient = scene.environment.ambient;
  if (ambient.r != ambient.g || ambient.g != ambient.b) notes.push_back("drawn grey: the ambient light");
  if (scene.image.shade == render::Shade::blinn) notes.push_back("not said: shade \"blinn\" (run with -shade_blinn)");
  if (shows_cut_paths(scene)) {
    notes.push_back("drawn brighter: what is seen beyond the last bounce (Tachyon shows all of the background there)");
  }
  return notes;
}

}  // namespace

WrittenScene write_tachyon(const SceneData& scene) {
  constexpr std::size_t kBytesPerSphere = 128;
  TextBuilder out(kStyle);
  out.reserve(scene.spheres.size() * kBytesPerSphere);
  write_heading(out, scene);
  write_camera(out, scene);
  for (const render::Light& light : scene.lights) write_light(out, light);
  write_materials(out, scene);
  write_shapes(out, scene);
  out << "END_SCENE\n";

  std::vector<std::string> notes = notes_for(scene);
  for (std::string& note : common_notes(scene)) notes.push_back(std::move(note));
  return {out.take(), std::move(notes), {}};
}

}  // namespace tessera::io
