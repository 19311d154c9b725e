// SPDX-License-Identifier: BSD-3-Clause
#include "app/info_command.h"

#include <algorithm>
#include <cstdio>

#include "app/memory_use.h"
#include "io/scene_reader.h"
#include "render/camera.h"
#include "render/scene.h"
#include "render/wavefront.h"

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

/// What one copy takes, which the ranks of a node share, and what each of them needs besides.
void print_memory(const render::Scene& scene) {
  const auto bytes = static_cast<double>(memory_bytes(scene));
  std::printf("memory       %.1f MiB a node", bytes / (1 << 20));
  if (scene.sphere_count() > 0) std::printf(", %.0f bytes a sphere", bytes / static_cast<double>(scene.sphere_count()));
  const std::size_t cell_bytes = render::Wavefront::most_cell_bytes(scene);
  if (cell_bytes > 0) std::printf("; up to %zu MiB a rank for shadows", cell_bytes >> 20);
  std::printf("\n");
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
  print_memory(render::Scene(std::move(data), render::Kernel::automatic));
  std::printf("skipped      %s\n", unused.c_str());
  return ExitCode::success;
}

}  // namespace tessera::app
