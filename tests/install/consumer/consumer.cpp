// SPDX-License-Identifier: BSD-3-Clause
// Somebody else's program: renders one pixel with the installed libraries.
#include <cstddef>
#include <vector>

#include "io/image_file.h"
#include "render/tile_renderer.h"
#include "scheduler/mpi/session.h"
#include "scheduler/policy.h"

int main() {
  using namespace tessera;
  render::SceneData data;
  data.materials.push_back({.color = {1, 1, 1}, .ambient = 1});
  data.spheres.push_back({{0, 0, 0}, 1, render::MaterialIndex{0}});
  data.camera = render::Camera{.eye = {0, -3, 0}};
  data.image.width = data.image.height = 1;
  const render::Scene scene(data, render::Kernel::automatic);
  std::vector<std::byte> pixel(3);
  render::TileRenderer(scene, render::PixelFormat::rgb8).render({0, 0, 1, 1}, {pixel}, [] {});
  const bool is_named = scheduler::parse_policy("guided").has_value() && io::image_format_of("a.png").has_value();
  // Linked, not run: a launcher would have to start it.
  const auto open_session = [](int argc, char** argv) { return scheduler::mpi::Session(argc, argv).size(); };
  (void)open_session;
  return pixel[0] == std::byte{255} && is_named ? 0 : 1;
}
