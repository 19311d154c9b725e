// SPDX-License-Identifier: BSD-3-Clause
#include "app/info_command.h"

#include <algorithm>
#include <cstdio>

#include "io/scene_reader.h"
#include "render/camera.h"
#include "render/scene.h"

namespace tessera::app {
namespace {

void print_vector(const char* name, const render::Vec3& v) {
  std::printf("%-12s %.6g %.6g %.6g\n", name, v.x, v.y, v.z);
}

/// Things of the rendering model that this scene has no use for.
std::string unused_parts(const render::SceneData& scene) {
  const auto none = [&](auto weight) { return std::none_of(scene.materials.begin(), scene.materials.end(), weight); };
  std::string parts;
  const auto add = [&](const char* part) { parts += (parts.empty() ? "" : ", ") + std::string(part); };
  if (none([](const render::Material& m) { return m.reflection > 0; })) add("mirror rays");
  if (none([](const render::Material& m) { return m.specular > 0; }) || scene.lights.empty()) add("highlights");
  if (scene.lights.empty()) add("shadow rays");
  if (scene.spheres.empty()) add("sphere tests");
  return parts.empty() ? "nothing" : parts;
}

}  // namespace

ExitCode run_info(const InfoOptions& options) {
  auto [data, notes] = io::read_scene(options.input);
  for (const std::string& note : notes) std::printf("note         %s\n", note.c_str());
  std::printf("spheres      %zu\nplanes       %zu\nlights       %zu\nmaterials    %zu\n", data.spheres.size(),
              data.planes.size(), data.lights.size(), data.materials.size());
  std::printf("image        %ux%u, %u per pixel, %u bounces\n", data.image.width, data.image.height, data.image.samples,
              data.image.max_bounces);
  std::printf("camera       %s\n", data.camera ? "given" : "framed to the bounds");

  const std::size_t spheres = data.spheres.size();
  const auto radius_less = [](const render::Sphere& a, const render::Sphere& b) { return a.radius < b.radius; };
  if (spheres > 0) {
    const render::Box bounds = bounds_of(data);
    print_vector("bounds from", bounds.lo);
    print_vector("bounds to", bounds.hi);
    const auto [least, most] = std::minmax_element(data.spheres.begin(), data.spheres.end(), radius_less);
    std::printf("radii        %.6g to %.6g\n", least->radius, most->radius);
  }
  const std::string unused = unused_parts(data);
  const render::Scene scene(std::move(data), render::Kernel::automatic);
  const std::size_t bytes = scene.bvh().memory_bytes() + spheres * sizeof(render::Sphere);
  std::printf("memory       %.1f MiB a rank", static_cast<double>(bytes) / (1 << 20));
  if (spheres > 0) std::printf(", %.0f bytes a sphere", static_cast<double>(bytes) / static_cast<double>(spheres));
  std::printf("\nskipped      %s\n", unused.c_str());
  return ExitCode::success;
}

}  // namespace tessera::app
