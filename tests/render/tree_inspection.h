// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <set>
#include <span>
#include <vector>

#include "render/bvh_build.h"

// What a tree promises whatever it is built of.
namespace tessera::render::test {

/// Whether a sphere lies inside a box in scene coordinates.
inline bool is_within(const Sphere& sphere, const Box& box) {
  const Vec3 r{sphere.radius, sphere.radius, sphere.radius};
  return box.contains(sphere.center - r) && box.contains(sphere.center + r);
}

/// Walks a whole tree and counts what breaks its promises.
struct Inspection {
  const Bvh& bvh;
  std::span<const Sphere> all;
  int outside = 0;  ///< spheres that leave a box around them
  int deepest = 0;
  std::size_t highest_stack = 0;  ///< of a search that meets everything, whichever children it takes first
  std::multiset<std::size_t> spheres;

  Inspection(const Bvh& tree, std::span<const Sphere> scene) : bvh(tree), all(scene) {
    if (bvh.nodes().empty()) return;
    visit(0, {});
    highest_stack = stack_of(0);
  }

  void visit(std::uint32_t child, const std::vector<Box>& around) {
    deepest = std::max(deepest, static_cast<int>(around.size()));
    if (!TreeChild::is_leaf(child)) {
      const TreeNode& node = bvh.nodes()[child];
      for (int i = 0; i != kTreeWidth; ++i) {
        std::vector<Box> boxes = around;
        boxes.push_back(bvh.child_box(node, i));
        if (!boxes.back().is_empty()) visit(node.child[i], boxes);
      }
      return;
    }
    for (const SurfaceId id : bvh.leaves()[TreeChild::index(child)].id) {
      if (id == SurfaceId::none) continue;
      spheres.insert(index_of(id));
      for (const Box& box : around) outside += !is_within(all[index_of(id)], box);
    }
  }

  /// The most that are ever put aside on the way through a child, itself included: it is taken off, its children are
  /// put aside, and one after the other is gone through above those that are left.
  std::size_t stack_of(std::uint32_t child) const {
    if (TreeChild::is_leaf(child)) return 1;
    const TreeNode& node = bvh.nodes()[child];
    std::size_t children = 0;
    std::size_t deepest_of_children = 0;
    for (int i = 0; i != kTreeWidth; ++i) {
      if (bvh.child_box(node, i).is_empty()) continue;
      ++children;
      deepest_of_children = std::max(deepest_of_children, stack_of(node.child[i]));
    }
    return children - 1 + deepest_of_children;
  }
};

/// That a tree holds every sphere that can be hit once, within all boxes around it, and leaves room in a stack.
inline void check_invariants(std::span<const Sphere> spheres) {
  const Bvh bvh = build_bvh(spheres);
  const Inspection found(bvh, spheres);
  BOOST_TEST(found.outside == 0);
  BOOST_TEST(found.deepest < Bvh::kMaxDepth);
  BOOST_TEST(found.highest_stack <= static_cast<std::size_t>(Bvh::kStackSize));
  std::multiset<std::size_t> expected;
  for (std::size_t i = 0; i != spheres.size(); ++i) {
    if (spheres[i].radius > 0) expected.insert(i);
  }
  BOOST_TEST((found.spheres == expected));
}

}  // namespace tessera::render::test
