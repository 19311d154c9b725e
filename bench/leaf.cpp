// SPDX-License-Identifier: BSD-3-Clause
// What a sphere in a leaf costs: the first look with its proven bounds, against the plain test that it is built on,
// and the exact intersection that the winner of a ray takes. The rays are those that a leaf sees: their lines pass
// through the sphere's box.
//   bench_leaf --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "render/box.h"
#include "render/sphere.h"

namespace {

using namespace tessera::render;

struct Pair {
  Ray ray;
  DirectionNorm norm;
  LookBounds bounds;
  Vec3 center;
  double radius;
};

/// Holds all spheres; see Scene::reach_from.
const Box kScene{{-5.1, -5.1, -5.1}, {5.1, 5.1, 5.1}};

std::vector<Pair> pairs() {
  std::mt19937_64 engine(1);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  const auto in_box = [&] { return Vec3{uniform(), uniform(), uniform()}; };
  std::vector<Pair> all;
  while (all.size() != 4096) {
    const Vec3 center = 5 * in_box();
    const double radius = 0.05 + 0.05 * std::abs(uniform());
    const Vec3 origin = center + 3 * normalized(in_box());
    const Vec3 direction = center + radius * in_box() - origin;
    const Ray ray{.origin = origin, .direction = direction};
    const DirectionNorm norm = norm_of(direction);
    all.push_back({ray, norm, look_bounds(norm, kScene.reach_from(origin)), center, radius});
  }
  return all;
}

/// Haines, Günther, Akenine-Möller, Ray Tracing Gems (2019), ch. 7, in double precision, without a bound on anything.
double plain_entry(const Pair& p) {
  const Vec3 f = p.center - p.ray.origin;
  const double foot = dot(f, p.ray.direction) * p.bounds.inverse_squared;
  const Vec3 perpendicular = f - foot * p.ray.direction;
  const double square = p.radius * p.radius - dot(perpendicular, perpendicular);
  if (square < 0 || foot < 0) return -1;
  return foot - std::sqrt(square) * p.bounds.inverse_length;
}

/// As nearest_hit does: the exact test only where the first look cannot tell.
double bounded_entry(const Pair& p) {
  const FirstLook look(p.ray, p.bounds, p.center, p.radius);
  if (look.surely_passes(p.bounds)) return -1;
  if (look.surely_meets(p.bounds)) {
    const Bounded t = look.entry(p.bounds);
    return t.value - t.error;
  }
  if (look.surely_lies_behind(p.bounds)) return -1;
  const auto crossing = entry_into(p.ray, p.norm, p.center, p.radius);
  return crossing ? crossing->t.value : -1;
}

double exact_entry(const Pair& p) {
  const auto crossing = entry_into(p.ray, p.norm, p.center, p.radius);
  return crossing ? crossing->t.value : -1;
}

template <double (*Test)(const Pair&)>
void BM_TestLeaf(benchmark::State& state) {
  const auto all = pairs();
  for (auto _ : state) {
    for (const Pair& p : all) benchmark::DoNotOptimize(Test(p));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}
BENCHMARK(BM_TestLeaf<plain_entry>)->Name("BM_TestLeaf/plain");
BENCHMARK(BM_TestLeaf<bounded_entry>)->Name("BM_TestLeaf/bounded");
BENCHMARK(BM_TestLeaf<exact_entry>)->Name("BM_TestLeaf/exact");

}  // namespace
