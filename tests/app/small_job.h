// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <string>
#include <vector>

#include "app/render_job.h"
#include "io/image_file.h"
#include "io/pfm.h"
#include "io/signature_file.h"
#include "render/tile.h"

// A small render that has everything a picture can depend on: mirrors, shadows, overlapping spheres, a checkered
// floor, point and directional light, several samples. Its picture is what every schedule must reproduce.
namespace tessera::app::test {

inline render::SceneData small_scene() {
  using render::MaterialIndex;
  render::SceneData scene;
  scene.materials = {{{0.8, 0.3, 0.2}, 0.1, 0.8, 0.5, 40, 0.3},
                     {{0.9, 0.9, 0.9}, 0.1, 0.5, 0, 1, 0.8},
                     {{0.2, 0.2, 0.3}, 0.2, 0.8, 0, 1, 0}};
  std::mt19937 random(7);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (std::uint32_t i = 0; i != 40; ++i) {
    scene.spheres.push_back(
        {{4 * number() - 2, 4 * number() - 2, 2 * number()}, 0.1 + 0.4 * number(), static_cast<MaterialIndex>(i % 2)});
  }
  scene.planes.push_back({{0, 0, -0.5}, {0.1, 0, 1}, MaterialIndex{2}, render::Checker{MaterialIndex{0}, 0.7}});
  scene.lights = {{render::LightKind::point, {3, -3, 6}, {0.7, 0.7, 0.6}},
                  {render::LightKind::directional, {-1, 2, -3}, {0.2, 0.2, 0.4}}};
  scene.camera = render::Camera{.eye = {3, -5, 3}, .target = {0, 0, 0.7}};
  scene.environment.background = {0.1, 0.3, 0.7};
  scene.image.width = 37;
  scene.image.height = 29;
  scene.image.samples = 4;
  scene.image.max_bounces = 4;
  return scene;
}

inline RenderJob small_job() {
  RenderJob job;
  job.scene = small_scene();
  job.area = {0, 0, job.scene.image.width, job.scene.image.height};
  job.layers = {.signatures = true, .errors = true};
  return job;
}

/// Tiles that shrink as if they had been cut by cost, the dearest first.
inline std::vector<render::CostedTile> uneven_tiles(const render::Rect& area) {
  const auto cost_of = [](const render::Rect& rect) { return 1e-6 * static_cast<double>(rect.pixels()); };
  return render::cut_by_cost(area, 32, cost_of, [](double left) { return left / 6; });
}

/// How a picture may be cut and shared out.
struct Sharing {
  scheduler::Policy policy;
  std::uint32_t tile_width;  ///< 0: uneven tiles
  std::uint32_t tile_height;

  void apply_to(RenderJob& job) const {
    job.policy = policy;
    job.tile_width = tile_width;
    job.tile_height = tile_height;
    job.cut = tile_width > 0 ? std::vector<render::CostedTile>() : uneven_tiles(job.area);
  }
  std::string text() const {
    return std::string(name_of(policy)) + " " + std::to_string(tile_width) + "x" + std::to_string(tile_height);
  }
};

/// Every policy with tiles of 1x1, 7x5, 16, 64, the whole picture, and uneven ones.
inline std::vector<Sharing> all_sharings(const RenderJob& job) {
  using scheduler::Policy;
  std::vector<Sharing> sharings{{Policy::static_bands, 16, 16}, {Policy::cyclic_rows, 16, 16}};
  for (const Policy policy :
       {Policy::dynamic, Policy::self_scheduling, Policy::guided, Policy::factoring, Policy::trapezoid}) {
    sharings.push_back({policy, 1, 1});
    sharings.push_back({policy, 7, 5});
    sharings.push_back({policy, 16, 16});
    sharings.push_back({policy, 64, 64});
    sharings.push_back({policy, job.area.width, job.area.height});
    sharings.push_back({policy, 0, 0});
  }
  return sharings;
}

/// The picture, signatures and error bounds that a run makes, one file after the other; `run` takes plan, work and
/// accept.
template <class Run>
std::string files_of(const RenderJob& job, const render::Scene& scene, std::uint32_t ranks, Run&& run) {
  const auto tiles = tiles_of(job, ranks);
  Mosaic mosaic(job, tiles);
  run(plan_of(job, tiles), TileWork(scene, job, tiles),
      [&](scheduler::TaskId task, std::span<const std::byte> delivered) { mosaic.accept(task, delivered); });
  return io::encode_image(io::ImageFormat::png, mosaic.image(), job.scene.image.transfer, {}) +
         io::encode_signatures(mosaic.signatures()) + io::encode_pfm(job.area.width, job.area.height, mosaic.errors());
}

/// The picture that everything is compared with: one tile, one rank, nothing scheduled.
inline std::string reference_files(const RenderJob& job, const render::Scene& scene) {
  RenderJob whole = job;
  Sharing{scheduler::Policy::dynamic, job.area.width, job.area.height}.apply_to(whole);
  return files_of(whole, scene, 1, [](const auto&, const auto& work, const auto& accept) {
    accept(scheduler::TaskId{0}, work(scheduler::TaskId{0}, [] {}));
  });
}

}  // namespace tessera::app::test
