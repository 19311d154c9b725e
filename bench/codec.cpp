// SPDX-License-Identifier: BSD-3-Clause
// What it costs to send pixels home: nanoseconds a pixel on the rank that renders (EncodeTile) and on rank 0
// (AcceptTile), and bytes a pixel on the way, over all tiles of a picture.
//   bench_codec --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <vector>

#include "app/render_job.h"
#include "app/tile_codec.h"
#include "workload.h"

namespace {

using namespace tessera;
using namespace tessera::app;

constexpr std::uint32_t kSide = 512;

/// A picture cut in tiles: half of it sky, half of it spheres.
struct Picture {
  explicit Picture(std::uint32_t tile_side) {
    job.scene = bench::scene_of(bench::flake());
    job.scene.camera->fov = 20;
    job.scene.image.width = job.scene.image.height = kSide;
    job.area = {0, 0, kSide, kSide};
    job.tile_width = job.tile_height = tile_side;
    tiles = tiles_of(job, 1);
    const render::Scene scene(job.scene, job.kernel);
    const render::TileRenderer renderer(scene, job.format);
    for (const render::Rect& tile : tiles) {
      colors.emplace_back(tile.pixels() * bytes_per_pixel(job.format));
      rays.push_back(renderer.render(tile, {colors.back()}, [] {}));
    }
  }

  std::vector<scheduler::Bytes> encoded(const TileCodec& codec) {
    std::vector<scheduler::Bytes> all;
    for (std::size_t i = 0; i != tiles.size(); ++i) all.push_back(codec.encode(rays[i], {colors[i]}));
    return all;
  }

  RenderJob job;
  std::vector<render::Rect> tiles;
  std::vector<std::vector<std::byte>> colors;
  std::vector<render::RayCounts> rays;
};

void count_pixels(benchmark::State& state) {
  const auto pixels = state.iterations() * std::int64_t{kSide} * kSide;
  state.SetItemsProcessed(pixels);
  state.counters["s_per_pixel"] =
      benchmark::Counter(static_cast<double>(pixels), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void encode_tiles(benchmark::State& state, Packing packing) {
  Picture picture(static_cast<std::uint32_t>(state.range(0)));
  const TileCodec codec(picture.job.format, {}, packing);
  std::size_t bytes = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i != picture.tiles.size(); ++i) {
      bytes += codec.encode(picture.rays[i], {picture.colors[i]}).size();
    }
  }
  count_pixels(state);
  state.counters["bytes_per_pixel"] =
      static_cast<double>(bytes) / static_cast<double>(state.iterations()) / kSide / kSide;
}

void accept_tiles(benchmark::State& state, Packing packing) {
  Picture picture(static_cast<std::uint32_t>(state.range(0)));
  const auto delivered = picture.encoded(TileCodec(picture.job.format, {}, packing));
  for (auto _ : state) {
    state.PauseTiming();
    Mosaic mosaic(picture.job, picture.tiles);
    state.ResumeTiming();
    for (std::uint32_t i = 0; i != delivered.size(); ++i) mosaic.accept(scheduler::TaskId{i}, delivered[i]);
    benchmark::DoNotOptimize(mosaic.image().bytes.data());
    benchmark::ClobberMemory();
  }
  count_pixels(state);
}

BENCHMARK_CAPTURE(encode_tiles, plain, Packing::never)->Name("BM_EncodeTile/plain")->Arg(16)->Arg(32)->Arg(64);
BENCHMARK_CAPTURE(encode_tiles, lz4, Packing::where_shorter)->Name("BM_EncodeTile/lz4")->Arg(16)->Arg(32)->Arg(64);
BENCHMARK_CAPTURE(accept_tiles, plain, Packing::never)->Name("BM_AcceptTile/plain")->Arg(16)->Arg(32)->Arg(64);
BENCHMARK_CAPTURE(accept_tiles, lz4, Packing::where_shorter)->Name("BM_AcceptTile/lz4")->Arg(16)->Arg(32)->Arg(64);

}  // namespace
