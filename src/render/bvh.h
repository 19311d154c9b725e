// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "render/box.h"
#include "render/ray.h"
#include "render/shared_array.h"
#include "render/tree_space.h"

// A bounding volume hierarchy over spheres, eight children wide: it finds the few that a ray may meet, and loses none.
namespace tessera::render {

inline constexpr int kTreeWidth = 8;

/// A node's children, or nothing where there are fewer. They are stored in columns, so that one instruction sees all.
struct alignas(32) TreeNode {
  float bounds[3][2][kTreeWidth];  ///< by axis: low sides, high sides; in tree space
  std::uint32_t child[kTreeWidth];
};

/// Up to eight spheres in tree space, for a first look at all of them together.
struct alignas(32) TreeLeaf {
  /// Minus this is the radius in lanes that are left over: nothing can meet them.
  static constexpr float kNowhere = 1e30F;

  float center[3][kTreeWidth];
  float radius[kTreeWidth];  ///< with the sphere's share of the error; see TreeRay
  SurfaceId id[kTreeWidth];  ///< none in the lanes that are left over

  /// Without spheres: no ray meets any of its lanes.
  static TreeLeaf empty() noexcept {
    TreeLeaf leaf{};
    std::fill(std::begin(leaf.radius), std::end(leaf.radius), -kNowhere);
    std::fill(std::begin(leaf.id), std::end(leaf.id), SurfaceId::none);
    return leaf;
  }
};

/// A child: an inner node, or a leaf.
struct TreeChild {
  static constexpr std::uint32_t kLeafBit = 0x8000'0000;

  static bool is_leaf(std::uint32_t child) noexcept { return (child & kLeafBit) != 0; }
  static std::uint32_t index(std::uint32_t child) noexcept { return child & ~kLeafBit; }
};

class Bvh {
 public:
  /// Levels of inner nodes that no build exceeds, and so the room that a traversal needs.
  static constexpr int kMaxDepth = 32;
  static constexpr int kStackSize = kMaxDepth * (kTreeWidth - 1) + 1;

  Bvh() = default;
  Bvh(const TreeSpace& space, SharedArray<TreeNode> nodes, SharedArray<TreeLeaf> leaves) noexcept
      : space_(space), nodes_(std::move(nodes)), leaves_(std::move(leaves)) {}

  const TreeSpace& space() const noexcept { return space_; }
  /// The root is the first; none where there is no sphere that can be hit.
  std::span<const TreeNode> nodes() const noexcept { return nodes_; }
  std::span<const TreeLeaf> leaves() const noexcept { return leaves_; }
  std::size_t memory_bytes() const noexcept;

  /// The box of a node's child, in scene coordinates.
  Box child_box(const TreeNode& node, int child) const noexcept;

  /// Calls visit(sphere) for every sphere that the ray may meet before `t_max`, near boxes first. `visit` may
  /// lower `t_max`; it returns true to end the search. The specification of what faster kernels do.
  /// units:   t_max in multiples of |ray.direction|; inverse_length is 1 / |ray.direction|
  template <class Visit>
  void visit_along(const Ray& ray, double inverse_length, const double& t_max, Visit&& visit) const;

  /// Calls visit(sphere) for every sphere in a leaf whose box, and all boxes around it, `meets(box)`.
  template <class Meets, class Visit>
  void visit_where(Meets&& meets, Visit&& visit) const;

 private:
  TreeSpace space_;
  SharedArray<TreeNode> nodes_;
  SharedArray<TreeLeaf> leaves_;
};

/// Whether the ray meets a child's box before `t_max`, and if so where it enters.
inline bool meets_child(const TreeNode& node, int child, const TreeRay& ray, float t_max, float& entry) noexcept {
  float enter = 0;
  float leave = t_max;
  for (int axis = 0; axis != 3; ++axis) {
    const auto& sides = node.bounds[axis];
    const unsigned side = ray.near_side[axis];
    enter = std::max(enter, (sides[side][child] - ray.near_origin[axis]) * ray.inverse[axis]);
    leave = std::min(leave, (sides[1 - side][child] - ray.far_origin[axis]) * ray.inverse[axis]);
  }
  entry = enter;
  return enter <= leave * TreeRay::kSlack;
}

/// Whether the ray may meet a leaf's sphere before `t_max`: a first look in float.
inline bool may_meet(const TreeLeaf& leaf, int lane, const TreeRay& ray, float t_max) noexcept {
  float f[3];
  for (int axis = 0; axis != 3; ++axis) f[axis] = leaf.center[axis][lane] - ray.origin[axis];
  const float foot = f[0] * ray.direction[0] + f[1] * ray.direction[1] + f[2] * ray.direction[2];
  float square = 0;
  for (int axis = 0; axis != 3; ++axis) {
    const float p = f[axis] - foot * ray.direction[axis];
    square += p * p;
  }
  const float reach = leaf.radius[lane] + ray.sphere_error;
  return square <= reach * reach && foot >= -reach && foot - reach <= t_max;
}

template <class Visit>
void Bvh::visit_along(const Ray& ray, double inverse_length, const double& t_max, Visit&& visit) const {
  if (nodes_.empty()) return;
  const TreeRay tree_ray(space_, ray, inverse_length);
  struct Entry {
    std::uint32_t child;
    float t;
  };
  std::array<Entry, kStackSize> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0};
  while (size > 0) {
    const Entry top = stack[--size];
    // A hit found since this box was put aside may have made it superfluous.
    const float latest = tree_ray.t_of(t_max);
    if (!(top.t <= latest * TreeRay::kSlack)) continue;
    if (TreeChild::is_leaf(top.child)) {
      const TreeLeaf& leaf = leaves_[TreeChild::index(top.child)];
      for (int lane = 0; lane != kTreeWidth && leaf.id[lane] != SurfaceId::none; ++lane) {
        if (may_meet(leaf, lane, tree_ray, latest) && visit(leaf.id[lane])) return;
      }
      continue;
    }
    // Put aside the children that are met, the nearest on top.
    const TreeNode& node = nodes_[top.child];
    const std::size_t first = size;
    for (int child = 0; child != kTreeWidth; ++child) {
      Entry met{node.child[child], 0};
      if (!meets_child(node, child, tree_ray, latest, met.t)) continue;
      std::size_t place = size++;
      for (; place > first && stack[place - 1].t < met.t; --place) stack[place] = stack[place - 1];
      stack[place] = met;
    }
  }
}

template <class Meets, class Visit>
void Bvh::visit_where(Meets&& meets, Visit&& visit) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, kStackSize> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t top = stack[--size];
    if (TreeChild::is_leaf(top)) {
      for (const SurfaceId id : leaves_[TreeChild::index(top)].id) {
        if (id != SurfaceId::none) visit(id);
      }
      continue;
    }
    const TreeNode& node = nodes_[top];
    for (int child = 0; child != kTreeWidth; ++child) {
      const Box box = child_box(node, child);
      if (!box.is_empty() && meets(box)) stack[size++] = node.child[child];
    }
  }
}

}  // namespace tessera::render
