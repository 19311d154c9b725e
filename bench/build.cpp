// SPDX-License-Identifier: BSD-3-Clause
// Spheres per second that a tree is built of, and what it weighs.
//   bench_build --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include "render/bvh_build.h"
#include "workload.h"

namespace {

using namespace tessera;

void build_tree(benchmark::State& state, const std::vector<render::Sphere>& spheres) {
  std::size_t bytes = 0;
  for (auto _ : state) {
    const render::Bvh bvh = render::build_bvh(spheres);
    bytes = bvh.memory_bytes();
    benchmark::DoNotOptimize(bytes);
  }
  const auto count = static_cast<std::int64_t>(spheres.size());
  state.SetItemsProcessed(state.iterations() * count);
  state.counters["bytes_per_sphere"] = static_cast<double>(bytes) / static_cast<double>(count);
}

void BM_BuildTree_cloud(benchmark::State& state) {
  build_tree(state, bench::cloud_of(static_cast<std::uint64_t>(state.range(0))));
}
BENCHMARK(BM_BuildTree_cloud)
    ->Name("BM_BuildTree/cloud")
    ->Arg(10'000)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond);

void BM_BuildTree_flake(benchmark::State& state) {
  build_tree(state, bench::flake());
}
BENCHMARK(BM_BuildTree_flake)->Name("BM_BuildTree/flake/66430")->Unit(benchmark::kMillisecond);

}  // namespace
