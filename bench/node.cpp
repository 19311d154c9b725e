// SPDX-License-Identifier: BSD-3-Clause
// What the scalar kernel pays for a node's eight boxes, and for a first look at a leaf's spheres: of the nodes and
// leaves that rays do come to. BM_TraceNearest of bench_trace shows what the avx2 kernel makes of both.
//   bench_node --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <limits>

#include "render/bvh_build.h"
#include "workload.h"

namespace {

using namespace tessera::bench;
using namespace tessera::render;

/// A ray at each node or leaf on its way, wherever it is hit.
struct Visits {
  Scene scene{scene_of(cloud_of(100'000)), Kernel::scalar};
  PictureRays rays{scene};
  std::vector<std::pair<TreeRay, const TreeNode*>> nodes;
  std::vector<std::pair<TreeRay, const TreeLeaf*>> leaves;

  Visits() {
    for (std::size_t i = 0; i < rays.camera.size() && nodes.size() < 8192; i += 61) follow(rays.camera[i].ray);
  }

 private:
  void follow(const Ray& ray) {
    const Bvh& bvh = scene.bvh();
    const TreeRay tree_ray(bvh.space(), ray, 1 / length(ray.direction));
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
      const std::uint32_t child = open.back();
      open.pop_back();
      if (TreeChild::is_leaf(child)) {
        leaves.emplace_back(tree_ray, &bvh.leaves()[TreeChild::index(child)]);
        continue;
      }
      const TreeNode& node = bvh.nodes()[child];
      nodes.emplace_back(tree_ray, &node);
      float entry = 0;
      for (int i = 0; i != kTreeWidth; ++i) {
        if (meets_child(node, i, tree_ray, std::numeric_limits<float>::max(), entry)) open.push_back(node.child[i]);
      }
    }
  }
};

const Visits& visits() {
  static const Visits all;
  return all;
}

template <class Pairs, class Test>
void test_all_lanes(benchmark::State& state, const Pairs& pairs, Test&& test) {
  for (auto _ : state) {
    for (const auto& [ray, columns] : pairs) {
      int met = 0;
      for (int lane = 0; lane != kTreeWidth; ++lane) met += test(*columns, lane, ray);
      benchmark::DoNotOptimize(met);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs.size()));
}

void BM_TestNode(benchmark::State& state) {
  test_all_lanes(state, visits().nodes, [](const TreeNode& node, int child, const TreeRay& ray) {
    float entry = 0;
    return meets_child(node, child, ray, 10, entry);
  });
}
BENCHMARK(BM_TestNode)->Name("BM_TestNode/scalar/8");

void BM_LookAtLeaf(benchmark::State& state) {
  test_all_lanes(state, visits().leaves,
                 [](const TreeLeaf& leaf, int lane, const TreeRay& ray) { return may_meet(leaf, lane, ray, 10); });
}
BENCHMARK(BM_LookAtLeaf)->Name("BM_LookAtLeaf/scalar/8");

}  // namespace
