// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/bvh.h"
#include "render/tree_space.h"

// Many rays looked at as one: what none of them can meet is left out for all of them together.
namespace tessera::render {

/// Rays that start in one point, or that run in one direction: those with x and y in a rectangle.
/// error:   origins and directions may be off by 2^-50 of |origin| + |x right| + |y down| or |axis| + ...
struct Pencil {
  enum class Kind {
    pyramid,  ///< origin + s (axis + x right + y down), s >= 0
    prism,    ///< origin + x right + y down + s axis, s >= 0
  };

  Kind kind;
  Vec3 origin;  ///< in scene coordinates
  Vec3 axis;    ///< of any length; the three need not be perpendicular to each other
  Vec3 right;
  Vec3 down;
  std::array<double, 2> x;
  std::array<double, 2> y;
};

/// A part of tree space between four planes, with all that a pencil of rays can meet.
///
/// error:   A point of a sphere that a ray of the pencil meets lies, between the depths at which spheres begin and end,
///          in the convex hull of eight points: where the pencil's four edges reach these depths. For any vector n the
///          sum n.p is least in a corner; so whatever normals are taken and however they are rounded, nothing is lost
///          if only the offset is computed from the eight points with the rounded normal. In the same way, as
///          |a| <= 1, a.p grows by t at most along a ray. Corners in double are off by less than 2^-48 (|O| + |P - O|),
///          what the pencil itself is off by included. Float sums of three products and an offset are
///          off by 6 2^-24 times the sum of their sizes: kRounding outweighs it, and so does what spheres of a leaf
///          have been given in advance (see TreeRay).
struct TreeFrustum {
  static constexpr int kPlanes = 4;
  static constexpr float kRounding = 0x1p-21F;
  /// Keeps what is far away, or not bounded, from overflowing.
  static constexpr double kFarthest = 0x1p80;
  /// A pencil is not bounded that has an edge at an angle to the axis whose cosine is below this, or nearly so.
  static constexpr double kLeastCosine = 0x1p-7;
  /// In place of 0, which must not be multiplied with the infinite sides of a box that is none.
  static constexpr float kNextToNothing = 0x1p-100F;

  struct Plane {
    float normal[3];       ///< inward, |normal| <= 1
    unsigned far_side[3];  ///< by axis: 0 or 1 for the low or the high side of a box reaching farthest inward
    float offset;          ///< normal.p + offset >= 0 for all p inside
  };

  Plane planes[kPlanes];
  /// As a plane that rays cross head-on: normal.p + offset is at most as far as a ray comes from its start to p.
  Plane depth;
  /// From far away rays are said to start where the spheres do: this deep in tree units, beyond the first of their
  /// starts.
  double shift = 0;

  TreeFrustum() = default;
  TreeFrustum(const TreeSpace& space, const Pencil& pencil) noexcept;

 private:
  static Plane plane_of(const Vec3& direction) noexcept;
  void hold_everything() noexcept;
};

inline TreeFrustum::TreeFrustum(const TreeSpace& space, const Pencil& pencil) noexcept {
  const bool is_pyramid = pencil.kind == Pencil::Kind::pyramid;
  const Vec3 axis = normalized(pencil.axis);

  // The normals, of any length: the sides' own, tilted by as much as a pyramid opens.
  const Vec3 across = cross(pencil.right, pencil.down);
  const double sign = dot(across, pencil.axis) < 0 ? -1 : 1;
  const Vec3 to_right = sign * cross(pencil.down, pencil.axis);
  const Vec3 to_down = sign * cross(pencil.axis, pencil.right);
  const Vec3 tilt = is_pyramid ? sign * across : Vec3{};
  planes[0] = plane_of(to_right - pencil.x[0] * tilt);
  planes[1] = plane_of(pencil.x[1] * tilt - to_right);
  planes[2] = plane_of(to_down - pencil.y[0] * tilt);
  planes[3] = plane_of(pencil.y[1] * tilt - to_down);
  depth = plane_of(axis);

  // The edges, by depth along the axis.
  const Vec3 origin = space.from_scene(pencil.origin);
  Vec3 starts[4];
  Vec3 edges[4];
  double farthest = 0;  // |O| at most
  double longest = 0;   // |P - O| by depth at most
  double first = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner != 4; ++corner) {
    const double x = pencil.x[static_cast<std::size_t>(corner % 2)];
    const double y = pencil.y[static_cast<std::size_t>(corner / 2)];
    const Vec3 offset = x * pencil.right + y * pencil.down;
    const double size = std::abs(x) * sum_of_sizes(pencil.right) + std::abs(y) * sum_of_sizes(pencil.down);
    starts[corner] = is_pyramid ? origin : origin + space.scale * offset;
    const Vec3 edge = is_pyramid ? pencil.axis + offset : pencil.axis;
    const double along = dot(edge, axis);
    const double whole = sum_of_sizes(pencil.axis) + (is_pyramid ? size : 0);
    if (!(along > kLeastCosine * whole)) {
      hold_everything();
      return;
    }
    edges[corner] = edge / along;
    farthest = std::max(farthest, sum_of_sizes(origin) + (is_pyramid ? 0 : space.scale * size));
    longest = std::max(longest, whole / along);
    first = std::min(first, dot(starts[corner], axis));
  }
  const double middle = dot(space.middle, axis) - first;
  if (middle > 4 * space.extent) shift = middle - 1.001 * space.extent;
  const double end = std::max(shift, middle + 1.001 * space.extent);

  // Put the planes so that the eight corners are inside.
  Vec3 corners[8];
  for (int corner = 0; corner != 4; ++corner) {
    const double aside = dot(starts[corner], axis) - first;
    for (int side = 0; side != 2; ++side) {
      corners[2 * corner + side] = starts[corner] + ((side == 0 ? shift : end) - aside) * edges[corner];
    }
  }
  const double off = 0x1p-48 * (farthest + (end + farthest) * longest);
  const auto rounded_up = [&](double x) {
    return TreeSpace::up(std::clamp(x + off + kRounding * std::abs(x), -kFarthest, kFarthest));
  };
  const auto along = [](const Plane& plane, const Vec3& p) {
    return plane.normal[0] * p.x + plane.normal[1] * p.y + plane.normal[2] * p.z;
  };
  for (Plane& plane : planes) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& corner : corners) least = std::min(least, along(plane, corner));
    plane.offset = rounded_up(-least);
  }
  double most = -std::numeric_limits<double>::infinity();
  for (int corner = 0; corner != 4; ++corner) {
    most = std::max(most, along(depth, shift > 0 ? corners[2 * corner] : starts[corner]));
  }
  depth.offset = -rounded_up(most);
}

inline TreeFrustum::Plane TreeFrustum::plane_of(const Vec3& direction) noexcept {
  Plane plane{};
  const Vec3 unit = direction == Vec3{} ? Vec3{} : normalized(direction) * (1 - 0x1p-22);
  for (int i = 0; i != 3; ++i) {
    const auto n = static_cast<float>(unit[i]);
    plane.normal[i] = std::abs(n) < kNextToNothing ? kNextToNothing : n;
    plane.far_side[i] = plane.normal[i] > 0 ? 1 : 0;
  }
  return plane;
}

inline void TreeFrustum::hold_everything() noexcept {
  for (Plane& plane : planes) plane.offset = kFarthest;
  depth.offset = -kFarthest;
}

/// More than what float sums over a child's box are off by, but for the offset's share.
inline float rounding_of(const TreeNode& node, int child) noexcept {
  float size = 0;
  for (const auto& sides : node.bounds) size += std::max(sides[1][child], -sides[0][child]);
  return TreeFrustum::kRounding * size;
}

/// Whether a ray of the pencil may meet a child's box, and if so how far along a ray it begins at least.
/// units:   depth in tree units, from where rays are said to start
inline bool meets_child(const TreeNode& node, int child, const TreeFrustum& frustum, float& depth) noexcept {
  const auto& sides = node.bounds;
  const float rounding = rounding_of(node, child);
  const auto along = [&](const TreeFrustum::Plane& plane, unsigned flip, float start) {
    for (int axis = 2; axis >= 0; --axis) {
      start = std::fma(plane.normal[axis], sides[axis][plane.far_side[axis] ^ flip][child], start);
    }
    return start;
  };
  depth = along(frustum.depth, 1, frustum.depth.offset - rounding);
  return std::all_of(std::begin(frustum.planes), std::end(frustum.planes),
                     [&](const auto& plane) { return along(plane, 0, plane.offset + rounding) >= 0; });
}

/// The same of a leaf's sphere.
inline bool may_meet(const TreeLeaf& leaf, int lane, const TreeFrustum& frustum, float& depth) noexcept {
  const float radius = leaf.radius[lane];
  const auto along = [&](const TreeFrustum::Plane& plane, float start) {
    for (int axis = 2; axis >= 0; --axis) start = std::fma(plane.normal[axis], leaf.center[axis][lane], start);
    return start;
  };
  depth = along(frustum.depth, frustum.depth.offset - radius);
  return std::all_of(std::begin(frustum.planes), std::end(frustum.planes),
                     [&](const auto& plane) { return along(plane, plane.offset + radius) >= 0; });
}

}  // namespace tessera::render
