// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/bvh.h"
#include "render/scene_data.h"

namespace tessera::render {

struct Item;
struct Range;

/// Builds the tree top-down: each node is split in two where the surface area heuristic expects the cheapest
/// traversal, then the largest of its parts again, until there are eight. Spheres of radius 0 are left out: they are
/// never hit. Input that no plane can split (a million equal centres) is halved by position in the list, so the depth
/// stays within Bvh::kMaxDepth.
///
/// Threads share the splits of large nodes, then each builds subtrees. The tree has the same bits for any number.
/// shapes:  n >= 0 spheres; leaves hold 1 to 8 of them
/// source:  Wald, On fast construction of SAH-based bounding volume hierarchies (2007); Wald, Benthin, Boulos,
///          Getting rid of packets (2008), for wide nodes
Bvh build_bvh(std::span<const Sphere> spheres, unsigned threads = 1);

/// The same in two steps, for a tree whose memory belongs to somebody else.
class BvhBuild {
 public:
  /// `spheres` must outlive this.
  explicit BvhBuild(std::span<const Sphere> spheres, unsigned threads = 1);

  const TreeSpace& space() const noexcept { return space_; }
  std::size_t node_count() const noexcept { return node_count_; }
  std::size_t leaf_count() const noexcept { return leaf_count_; }

  /// Puts the tree in its place and gives up its parts.
  /// shapes:  node_count() nodes, leaf_count() leaves
  void move_to(std::span<TreeNode> nodes, std::span<TreeLeaf> leaves);

 private:
  /// A part of the tree, with indices of its own.
  struct Part {
    std::vector<TreeNode> nodes;
    std::vector<TreeLeaf> leaves;
  };
  /// A child of a node at the top that is a part of its own.
  struct Joint {
    std::uint32_t node;
    std::size_t lane;
  };
  struct Task;

  /// Both return the new node's index in its part.
  std::uint32_t build_top(const Range& range, int depth, std::vector<Task>& tasks);
  std::uint32_t build_subtree(const Range& range, int depth, Item* room, Part& to) const;
  std::uint32_t add_leaf(const Range& range, Part& to) const;

  std::span<const Sphere> spheres_;
  unsigned threads_;
  TreeSpace space_;
  std::vector<Part> parts_;    ///< the top, empty where one subtree is all, then subtrees
  std::vector<Joint> joints_;  ///< of the subtrees
  std::size_t node_count_ = 0;
  std::size_t leaf_count_ = 0;
};

}  // namespace tessera::render
