// SPDX-License-Identifier: BSD-3-Clause
#include "io/pov_writer.h"

#include <algorithm>
#include <cstddef>

#include "io/export_scene.h"
#include "io/text_builder.h"
#include "render/plane.h"
#include "render/power.h"
#include "render/scale.h"

namespace tessera::io {
namespace {

using render::MaterialIndex;
using render::SceneData;
using render::Vec3;

constexpr TripleStyle kStyle{"<", ", ", ">"};
constexpr std::uint32_t kMostBounces = 255;  // max_trace_level is at most 256, and counts the camera ray

void write_settings(TextBuilder& out, const SceneData& scene) {
  const auto& image = scene.image;
  const std::string_view gamma = image.transfer == render::Transfer::none ? " File_Gamma=1.0" : "";
  out << "// povray +IFILE +Oout.png +W" << std::uint64_t{image.width} << " +H" << std::uint64_t{image.height}
      << " -D +WT1 -A" << gamma << "\n#version 3.7;\n"
      << "global_settings { assumed_gamma 1 max_trace_level "
      << std::uint64_t{std::min(image.max_bounces, kMostBounces)} + 1 << " adc_bailout 0 ambient_light rgb "
      << scene.environment.ambient << " }\n"
      << "background { rgb " << scene.environment.background << " }\n";
}

/// Right and up are the sides of the picture, at distance 1 or through the eye.
void write_camera(TextBuilder& out, const SceneData& scene) {
  const render::Camera& camera = *scene.camera;
  const bool is_flat = camera.projection == render::Projection::orthographic;
  const double height = is_flat ? camera.height : 2 * render::tangent_of_degrees(camera.fov / 2);
  const double width = height * scene.image.width / scene.image.height;
  const Vec3 forward = normalized(camera.target - camera.eye);
  const Vec3 right = normalized(cross(forward, camera.up));
  out << "camera { " << (is_flat ? "orthographic " : "") << "location " << camera.eye << " direction " << forward
      << "\n  right " << (camera.handedness == render::Handedness::right ? width : -width) * right << " up "
      << height * cross(right, forward) << " }\n";
}

/// Parallel light comes from a plane, which must be behind everything.
void write_light(TextBuilder& out, const render::Light& light, double far) {
  if (light.kind == render::LightKind::point) {
    out << "light_source { " << light.vector << " rgb " << light.color << " }\n";
  } else {
    out << "light_source { " << -far * normalized(light.vector) << " rgb " << light.color << " parallel point_at "
        << Vec3{} << " }\n";
  }
}

TextBuilder& operator<<(TextBuilder& out, MaterialIndex index) {
  return out << "M" << static_cast<std::uint64_t>(index);
}

void write_highlight(TextBuilder& out, const render::Material& material, render::Shade shade) {
  if (material.specular == 0) return;
  if (shade == render::Shade::phong) {
    out << " phong " << material.specular << " phong_size " << material.shininess;
  } else {
    constexpr double kFlattest = 1e-6;
    out << " specular " << material.specular << " roughness " << 1 / std::max(material.shininess, kFlattest);
  }
}

void write_materials(TextBuilder& out, const SceneData& scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const render::Material material = with_added_mirror(scene.materials[i]);
    out << "#declare " << static_cast<MaterialIndex>(i) << " = texture { pigment { rgb " << material.color
        << " } finish { ambient " << material.ambient << " diffuse " << material.diffuse;
    write_highlight(out, material, scene.image.shade);
    if (material.reflection > 0) out << " reflection " << material.reflection;
    out << " } }\n";
  }
}

/// The board's axes as the images of x, y and z.
void write_board(TextBuilder& out, const render::Plane& plane) {
  const render::CheckerAxes axes(plane);
  const double size = plane.checker->size;
  const Vec3 normal = size * normalized(plane.normal);
  out << "\n  texture { checker texture { " << plane.material << " }, texture { " << plane.checker->material
      << " } matrix " << TripleStyle{"<", ", ", ", "} << size * axes.u << TripleStyle{"", ", ", ", "} << size * axes.v
      << normal << TripleStyle{"", ", ", ">"} << plane.point - 0.5 * normal << kStyle << " }";
}

void write_shapes(TextBuilder& out, const SceneData& scene) {
  for (const render::Plane& plane : scene.planes) {
    const Vec3 normal = normalized(plane.normal);
    out << "plane { " << normal << ", " << dot(plane.point, normal);
    if (plane.checker) {
      write_board(out, plane);
    } else {
      out << " texture { " << plane.material << " }";
    }
    out << " }\n";
  }
  for (const render::Sphere& sphere : scene.spheres) {
    if (sphere.radius == 0) continue;
    out << "sphere { " << sphere.center << ", " << sphere.radius << " texture { " << sphere.material << " } }\n";
  }
}

std::vector<std::string> notes_for(const SceneData& scene) {
  std::vector<std::string> notes;
  if (scene.image.max_bounces > kMostBounces) {
    notes.push_back("paths end after " + std::to_string(kMostBounces) + " bounces instead of " +
                    std::to_string(scene.image.max_bounces));
  }
  if (shows_cut_paths(scene)) {
    notes.push_back("drawn darker: what is seen beyond the last bounce (POV-Ray shows black there)");
  }
  return notes;
}

}  // namespace

WrittenScene write_pov(const SceneData& scene) {
  constexpr std::size_t kBytesPerSphere = 128;
  TextBuilder out(kStyle);
  out.reserve(scene.spheres.size() * kBytesPerSphere);
  write_settings(out, scene);
  write_camera(out, scene);
  const double far = 1000 * std::max(render::largest_length_of(scene), 1.0);
  for (const render::Light& light : scene.lights) write_light(out, light, far);
  write_materials(out, scene);
  write_shapes(out, scene);

  std::vector<std::string> notes = notes_for(scene);
  for (std::string& note : common_notes(scene)) notes.push_back(std::move(note));
  return {out.take(), std::move(notes), {}};
}

}  // namespace tessera::io
