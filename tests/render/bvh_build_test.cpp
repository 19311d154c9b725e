// SPDX-License-Identifier: BSD-3-Clause
// Input that no plane splits well, or at all.
#include "render/bvh_build.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "render/parallel_for.h"
#include "render/random.h"
#include "render/tree_inspection.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

Sphere sphere_at(const Vec3& center, double radius) {
  return {center, radius, MaterialIndex{0}};
}

/// `depth` levels of nodes with seven leaves and one node each, the last with eight leaves. All boxes are the same, but
/// for the one around the node: it is met first, so that all its siblings wait.
Bvh lopsided_tree(int depth) {
  std::vector<TreeNode> nodes(static_cast<std::size_t>(depth));
  std::vector<TreeLeaf> leaves;
  for (std::size_t level = 0; level != nodes.size(); ++level) {
    for (int child = 0; child != kTreeWidth; ++child) {
      const bool is_inner = child == 3 && level + 1 != nodes.size();
      for (auto& sides : nodes[level].bounds) {
        sides[0][child] = is_inner ? -0.9F : -0.5F;
        sides[1][child] = is_inner ? 0.9F : 0.5F;
      }
      const auto leaf = TreeChild::kLeafBit | static_cast<std::uint32_t>(leaves.size());
      nodes[level].child[child] = is_inner ? static_cast<std::uint32_t>(level + 1) : leaf;
      if (is_inner) continue;
      TreeLeaf& one = leaves.emplace_back(TreeLeaf::empty());
      one.radius[0] = 0.5F;
      one.id[0] = surface_id(leaves.size() - 1);
    }
  }
  TreeSpace space;
  space.extent = 2;
  return {space, nodes, leaves};
}

/// Whether two trees are the same to the last bit.
bool same_bytes(const Bvh& a, const Bvh& b) {
  const auto same = [](const auto& one, const auto& other) {
    const auto bytes = std::as_bytes(one);
    return std::ranges::equal(bytes, std::as_bytes(other));
  };
  return same(a.nodes(), b.nodes()) && same(a.leaves(), b.leaves());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(bvh_build)

// Many enough for nodes that threads split together; with a cluster that no plane cuts, and some that are never hit.
BOOST_AUTO_TEST_CASE(any_number_of_threads_builds_the_same_valid_tree) {
  Random random(115);
  std::vector<Sphere> spheres;
  for (int i = 0; i != 450'000; ++i) {
    const bool is_in_cluster = i % 3 == 0;
    spheres.push_back(sphere_at(is_in_cluster ? Vec3{0.25, 0.5, 2} : random.in_box(1),
                                i % 7 == 0 ? 0 : random.over_decades(1e-5, 1e-2)));
  }
  check_invariants(spheres);
  const Bvh one = build_bvh(spheres, 1);
  for (const unsigned threads : {2U, 3U, 16U}) BOOST_TEST(same_bytes(one, build_bvh(spheres, threads)), threads);
}

BOOST_AUTO_TEST_CASE(parallel_for_visits_all_and_hands_on_what_is_thrown) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    std::vector<std::atomic<int>> visits(1000);
    parallel_for(threads, visits.size(), [&](std::size_t i) { ++visits[i]; });
    BOOST_TEST(std::ranges::all_of(visits, [](int n) { return n == 1; }));
    parallel_for(threads, 0, [](std::size_t) { BOOST_ERROR("nothing to visit"); });
    const auto fail = [](std::size_t i) {
      if (i == 77) throw std::runtime_error("77");
    };
    BOOST_CHECK_THROW(parallel_for(threads, 1000, fail), std::runtime_error);
  }
}

BOOST_AUTO_TEST_CASE(equal_centers_of_all_sizes_build_a_valid_tree) {
  std::vector<Sphere> spheres;
  for (int i = 0; i != 5000; ++i) spheres.push_back(sphere_at({0.3, -0.7, 1e3}, std::ldexp(1.0, -i % 400)));
  check_invariants(spheres);
}

BOOST_AUTO_TEST_CASE(leaves_that_are_just_full_or_one_too_many_build_a_valid_tree) {
  for (const int count : {1, 7, 8, 9, 63, 64, 65}) {
    std::vector<Sphere> apart;
    for (int i = 0; i != count; ++i) apart.push_back(sphere_at({1.0 * i, 0.1 * i * i, 0}, 0.5));
    check_invariants(apart);
    check_invariants(std::vector<Sphere>(static_cast<std::size_t>(count), sphere_at({1, 2, 3}, 4)));
  }
}

BOOST_AUTO_TEST_CASE(spheres_on_a_line_build_a_valid_tree) {
  Random random(111);
  for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0, -1, 1}, Vec3{1, 1, 1}, Vec3{1e-9, 1, -1e-18}}) {
    std::vector<Sphere> spheres;
    for (int i = 0; i != 3000; ++i) {
      spheres.push_back(sphere_at(random.uniform(-1, 1) * direction, random.over_decades(1e-9, 0.1)));
    }
    check_invariants(spheres);
  }
}

// Each octave as far out as all before it together: on one axis, on all, towards either side, past a float's range.
BOOST_AUTO_TEST_CASE(geometric_sequences_build_a_valid_tree) {
  for (const double ratio : {0.5, 0.9, 0.01}) {
    for (const double size : {0.1, 1e-6}) {
      std::vector<Sphere> spheres;
      double x = 1;
      for (int i = 0; i != 2000 && x > 1e-140; ++i, x *= ratio) {
        const double sign = i % 2 == 0 ? 1 : -1;
        spheres.push_back(sphere_at({x, 0, 0}, size * x));
        spheres.push_back(sphere_at({-x, sign * x, 0.3 * x}, size * x));
      }
      check_invariants(spheres);
    }
  }
}

BOOST_AUTO_TEST_CASE(radii_over_many_decades_build_a_valid_tree) {
  Random random(112);
  for (const double place : {0.0, 1e-120, 1e-60, 1.0}) {
    std::vector<Sphere> spheres;
    for (int i = 0; i != 3000; ++i) spheres.push_back(sphere_at(random.in_box(place), random.over_decades(1e-120, 1)));
    check_invariants(spheres);
  }
}

// The base of the coordinates is in one cluster or between them; the other one has no extent in a float's eyes.
BOOST_AUTO_TEST_CASE(clusters_far_apart_build_a_valid_tree) {
  Random random(113);
  for (const int in_first : {100, 1500, 2900}) {
    std::vector<Sphere> spheres;
    for (int i = 0; i != 3000; ++i) {
      const Vec3 center = i < in_first ? Vec3{} : Vec3{1e9, -1e9, 1e9};
      spheres.push_back(sphere_at(center + random.in_box(1), random.over_decades(1e-3, 0.1)));
    }
    check_invariants(spheres);
  }
}

// Clusters of clusters, eight of eighths each time: what a median or a bin boundary separates is always lopsided.
BOOST_AUTO_TEST_CASE(self_similar_dust_builds_a_valid_tree) {
  Random random(114);
  std::vector<Sphere> spheres;
  for (int i = 0; i != 30000; ++i) {
    Vec3 p;
    double step = 1;
    for (int level = 0; level != 12; ++level, step *= 0.03) {
      const std::uint32_t corner = random.below(8) & random.below(8) & random.below(8);
      p = p + step * Vec3{1.0 * (corner & 1), 1.0 * (corner >> 1 & 1), 1.0 * (corner >> 2)};
    }
    spheres.push_back(sphere_at(p, random.over_decades(1e-15, 1e-3)));
  }
  check_invariants(spheres);
}

// As deep as any build may get, and on every level seven children wait: the stack is full to its last place.
BOOST_AUTO_TEST_CASE(deepest_tree_fits_the_stack) {
  const Bvh bvh = lopsided_tree(Bvh::kMaxDepth);
  const std::vector<Sphere> spheres(bvh.leaves().size(), sphere_at({0, 0, 0}, 0.1));
  BOOST_TEST(Inspection(bvh, spheres).highest_stack == static_cast<std::size_t>(Bvh::kStackSize));
  std::size_t visited = 0;
  const double t_max = std::numeric_limits<double>::infinity();
  bvh.visit_along({.origin = {-2, 0, 0}, .direction = {1, 0, 0}}, 1, t_max, [&](SurfaceId) { return ++visited == 0; });
  BOOST_TEST(visited == bvh.leaves().size());
  visited = 0;
  bvh.visit_where([](const Box&) { return true; }, [&](SurfaceId) { ++visited; });
  BOOST_TEST(visited == bvh.leaves().size());
}

BOOST_AUTO_TEST_SUITE_END()
