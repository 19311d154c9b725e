// SPDX-License-Identifier: BSD-3-Clause
// Pixels per second of a tile, with all that a task does but its messages: the dearest tile of a picture, one half of
// all are cheaper than, and the cheapest, which is sky.
//   bench_tile --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <algorithm>

#include "render/tile_renderer.h"
#include "workload.h"

namespace {

using namespace tessera::bench;
using namespace tessera::render;

constexpr std::uint32_t kTileSide = 16;

/// Mirrors upon mirrors over a floor.
SceneData flake_on_a_floor() {
  SceneData data = scene_of(flake());
  data.materials.push_back({});
  data.planes.push_back({{0, 0, -0.5}, {0, 0, 1}, MaterialIndex{1}, Checker{MaterialIndex{0}, 0.5}});
  data.camera->fov = 60;
  data.image.width = 320;
  data.image.height = 192;
  return data;
}

const Scene& scene_for(Kernel kernel) {
  static const SceneData data = flake_on_a_floor();
  if (kernel == Kernel::scalar) {
    static const Scene scene(data, Kernel::scalar);
    return scene;
  }
  static const Scene scene(data, kernel);
  return scene;
}

/// The tiles of the picture, the cheapest first.
const std::vector<Rect>& tiles_by_cost() {
  static const std::vector<Rect> sorted = [] {
    const Scene& scene = scene_for(runnable(Kernel::automatic));
    const TileRenderer renderer(scene, PixelFormat::rgb8);
    std::vector<std::byte> colors(3 * kTileSide * kTileSide);
    std::vector<std::pair<std::uint64_t, std::size_t>> costs;
    const auto tiles = tile_grid({0, 0, scene.data().image.width, scene.data().image.height}, kTileSide, kTileSide);
    for (std::size_t i = 0; i != tiles.size(); ++i) {
      costs.emplace_back(renderer.render(tiles[i], {colors}, [] {}).total(), i);
    }
    std::sort(costs.begin(), costs.end());
    std::vector<Rect> by_cost;
    for (const auto& [rays, tile] : costs) by_cost.push_back(tiles[tile]);
    return by_cost;
  }();
  return sorted;
}

/// shapes:  place in 0 ... 1, from the cheapest tile to the dearest
void render_tile(benchmark::State& state, Kernel kernel, double place) {
  const auto& tiles = tiles_by_cost();
  const Rect& tile = tiles[static_cast<std::size_t>(place * static_cast<double>(tiles.size() - 1))];
  const TileRenderer renderer(scene_for(kernel), PixelFormat::rgb8);
  std::vector<std::byte> colors(3 * tile.pixels());
  std::uint64_t rays = 0;
  for (auto _ : state) rays += renderer.render(tile, {colors}, [] {}).total();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(tile.pixels()));
  state.counters["rays"] = benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}

const bool kAreRegistered = [] {
  for (const Kernel kernel : tree_kernels()) {
    for (const auto& [name, place] : {std::pair{"dearest", 1.0}, {"median", 0.5}, {"cheapest", 0.0}}) {
      benchmark::RegisterBenchmark(("BM_RenderTile/" + name_of(kernel) + "_" + name + "/16").c_str(), render_tile,
                                   kernel, place);
    }
  }
  return true;
}();

}  // namespace
