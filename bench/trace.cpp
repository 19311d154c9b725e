// SPDX-License-Identifier: BSD-3-Clause
// Rays per second through a tree: to the nearest surface and to a light, coherent as camera rays are, and incoherent as
// those that mirrors send on.
//   bench_trace --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <memory>

#include "workload.h"

namespace {

using namespace tessera::bench;
using namespace tessera::render;

/// As many as a block of pixels has; one alone shows what the company of others is worth.
constexpr std::size_t kTogether = 256;

/// A scene prepared for a kernel, with its rays; made once, for all measurements of it.
struct Workload {
  Scene scene;
  PictureRays rays;

  Workload(std::vector<Sphere> spheres, Kernel kernel) : scene(scene_of(std::move(spheres)), kernel), rays(scene) {}
};

/// Of 0: the sphere flake.
const Workload& workload(std::uint64_t count, Kernel kernel) {
  static std::map<std::pair<std::uint64_t, Kernel>, std::unique_ptr<Workload>> all;
  auto& one = all[{count, kernel}];
  if (!one) one = std::make_unique<Workload>(count == 0 ? flake() : cloud_of(count), kernel);
  return *one;
}

using Rays = std::vector<RayInRegion> PictureRays::*;

/// Calls trace(rays) for batches of all rays until time is up.
template <class Trace>
void in_batches(benchmark::State& state, std::span<const RayInRegion> rays, std::size_t together, Trace&& trace) {
  for (auto _ : state) {
    for (std::size_t first = 0; first < rays.size(); first += together) {
      trace(rays.subspan(first, std::min(together, rays.size() - first)));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

void trace_nearest(benchmark::State& state, std::uint64_t count, Kernel kernel, Rays rays, std::size_t together) {
  const Workload& work = workload(count, kernel);
  std::vector<std::optional<SurfacePoint>> hits(together);
  in_batches(state, work.rays.*rays, together, [&](std::span<const RayInRegion> batch) {
    nearest_hits(work.scene, batch, std::span(hits).first(batch.size()));
    benchmark::DoNotOptimize(hits.data());
  });
}

void trace_shadow(benchmark::State& state, std::uint64_t count, Kernel kernel, Rays rays) {
  const Workload& work = workload(count, kernel);
  std::vector<std::uint8_t> occluded(kTogether);
  in_batches(state, work.rays.*rays, kTogether, [&](std::span<const RayInRegion> batch) {
    occlusions(work.scene, batch, 0, std::span(occluded).first(batch.size()));
    benchmark::DoNotOptimize(occluded.data());
  });
}

const bool kAreRegistered = [] {
  for (const std::uint64_t count : {1'000U, 100'000U, 1'000'000U, 0U}) {
    const std::string size = count == 0 ? "flake" : std::to_string(count);
    for (const Kernel kernel : tree_kernels()) {
      const auto nearest = [&](const std::string& rays, Rays of_picture, std::size_t together) {
        benchmark::RegisterBenchmark(("BM_TraceNearest/" + name_of(kernel) + "_" + rays + "/" + size).c_str(),
                                     trace_nearest, count, kernel, of_picture, together);
      };
      const auto shadow = [&](const std::string& rays, Rays of_picture) {
        benchmark::RegisterBenchmark(("BM_TraceShadow/" + name_of(kernel) + "_" + rays + "/" + size).c_str(),
                                     trace_shadow, count, kernel, of_picture);
      };
      nearest("camera", &PictureRays::camera, kTogether);
      nearest("mirror", &PictureRays::mirror, kTogether);
      nearest("mirror_alone", &PictureRays::mirror, 1);
      shadow("camera", &PictureRays::camera_shadow);
      shadow("mirror", &PictureRays::mirror_shadow);
    }
  }
  return true;
}();

}  // namespace
