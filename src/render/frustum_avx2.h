// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/frustum.h"
#include "render/lanes_avx2.h"

#if defined(__x86_64__)
// frustum.h for eight boxes or spheres at once; the same numbers.
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {

/// As meets_child, of all children; a box that is none is not met.
inline LaneMask meets_children(const TreeNode& node, const TreeFrustum& frustum, Float8& depth) noexcept {
  const auto side = [&](int axis, unsigned which) { return Float8::load(node.bounds[axis][which]); };
  const auto size = [&](int axis) { return max(side(axis, 1), Float8::all(0) - side(axis, 0)); };
  const Float8 rounding = Float8::all(TreeFrustum::kRounding) * (size(0) + size(1) + size(2));
  const auto along = [&](const TreeFrustum::Plane& plane, unsigned flip, Float8 start) {
    for (int axis = 2; axis >= 0; --axis) {
      start = fused(Float8::all(plane.normal[axis]), side(axis, plane.far_side[axis] ^ flip), start);
    }
    return start;
  };
  Float8 least = along(frustum.planes[0], 0, Float8::all(frustum.planes[0].offset) + rounding);
  for (int i = 1; i != TreeFrustum::kPlanes; ++i) {
    least = min(least, along(frustum.planes[i], 0, Float8::all(frustum.planes[i].offset) + rounding));
  }
  depth = along(frustum.depth, 1, Float8::all(frustum.depth.offset) - rounding);
  return Float8::all(0) <= least;
}

/// As may_meet, of all spheres; lanes that are left over do not.
inline LaneMask may_meet(const TreeLeaf& leaf, const TreeFrustum& frustum, Float8& depth) noexcept {
  const Float8 radius = Float8::load(leaf.radius);
  const auto along = [&](const TreeFrustum::Plane& plane, Float8 start) {
    for (int axis = 2; axis >= 0; --axis) {
      start = fused(Float8::all(plane.normal[axis]), Float8::load(leaf.center[axis]), start);
    }
    return start;
  };
  Float8 least = along(frustum.planes[0], Float8::all(frustum.planes[0].offset) + radius);
  for (int i = 1; i != TreeFrustum::kPlanes; ++i) {
    least = min(least, along(frustum.planes[i], Float8::all(frustum.planes[i].offset) + radius));
  }
  depth = along(frustum.depth, Float8::all(frustum.depth.offset) - radius);
  return Float8::all(0) <= least;
}

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#endif
