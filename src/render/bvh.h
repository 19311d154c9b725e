// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "render/ray.h"
#include "render/scene_data.h"

// A binary bounding volume hierarchy over spheres: it finds the few that a ray may meet, and loses none.
namespace tessera::render {

/// A sphere as the tree stores it, in leaf order.
struct LeafSphere {
  Vec3 center;
  double radius;
  SurfaceId id;
};

/// An axis-aligned box.
struct Box {
  Vec3 lo{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::infinity()};
  Vec3 hi{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()};

  void include(const Box& other) noexcept;
  bool contains(const Vec3& p) const noexcept;
  double half_area() const noexcept;
  /// The distance from `p` to the corner that is farthest from it, summed over the axes.
  double reach_from(const Vec3& p) const noexcept;
};

/// The box of a sphere, a little wider than the sphere: whatever sphere.h computes as hit lies inside.
Box bounds_of(const Vec3& center, double radius) noexcept;

class Bvh {
 public:
  /// An inner node has count 0 and its children at first and first + 1, a leaf its spheres from first on.
  struct Node {
    Box box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  /// Depth that no build exceeds, and so the room that a traversal needs.
  static constexpr int kMaxDepth = 96;

  Bvh() = default;
  Bvh(std::vector<Node> nodes, std::vector<LeafSphere> spheres)
      : nodes_(std::move(nodes)), spheres_(std::move(spheres)) {}

  std::span<const Node> nodes() const noexcept { return nodes_; }
  std::span<const LeafSphere> spheres() const noexcept { return spheres_; }
  std::size_t memory_bytes() const noexcept;

  /// Calls visit(sphere) for every sphere that the ray may meet before `t_max`, near boxes first. `visit` may
  /// lower `t_max`; it returns true to end the search.
  template <class Visit>
  void visit_along(const Ray& ray, const double& t_max, Visit&& visit) const;

  /// Calls visit(sphere) for every sphere in a leaf whose box, and all boxes around it, `meets(box)`.
  template <class Meets, class Visit>
  void visit_where(Meets&& meets, Visit&& visit) const;

 private:
  std::vector<Node> nodes_;
  std::vector<LeafSphere> spheres_;
};

/// A ray prepared for box tests: reciprocal direction, and per axis which side of a box is the near one.
class SlabTest {
 public:
  explicit SlabTest(const Ray& ray) noexcept
      : origin_(ray.origin), inverse_{inverse(ray.direction.x), inverse(ray.direction.y), inverse(ray.direction.z)} {}

  /// Whether something entered at `t` can hold a hit that is not after `t_max`.
  static bool is_before(double t, double t_max) noexcept { return t <= t_max * kSlack; }

  /// Where the ray enters the box, or infinity where it passes it or enters after `t_max`.
  /// error:   the slack covers the roundings of three slabs and of a sphere's t, so no hit before `t_max` is lost
  double entry(const Box& box, double t_max) const noexcept {
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    clip(box.lo.x, box.hi.x, origin_.x, inverse_.x, enter, leave);
    clip(box.lo.y, box.hi.y, origin_.y, inverse_.y, enter, leave);
    clip(box.lo.z, box.hi.z, origin_.z, inverse_.z, enter, leave);
    const bool met = enter <= leave * kSlack && is_before(enter, t_max);
    return met ? enter : std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr double kSlack = 1 + 0x1p-48;

  /// A ray parallel to a slab is inside of it for all t or for none. A huge finite reciprocal says so without
  /// 0 * infinity; a ray inside a face's own plane counts as outside, which loses nothing: boxes are wider than
  /// their spheres.
  static double inverse(double d) noexcept {
    constexpr double kHuge = 0x1p1000;
    return d == 0 ? kHuge : std::clamp(1 / d, -kHuge, kHuge);
  }

  static void clip(double lo, double hi, double origin, double inverse, double& enter, double& leave) noexcept {
    const double near = ((inverse < 0 ? hi : lo) - origin) * inverse;
    const double far = ((inverse < 0 ? lo : hi) - origin) * inverse;
    enter = near > enter ? near : enter;
    leave = far < leave ? far : leave;
  }

  Vec3 origin_;
  Vec3 inverse_;
};

template <class Visit>
void Bvh::visit_along(const Ray& ray, const double& t_max, Visit&& visit) const {
  if (nodes_.empty()) return;
  const SlabTest slabs(ray);
  struct Entry {
    std::uint32_t node;
    double t;
  };
  std::array<Entry, kMaxDepth + 1> stack;
  std::size_t size = 0;
  constexpr double kNever = std::numeric_limits<double>::infinity();

  const double root_entry = slabs.entry(nodes_[0].box, t_max);
  if (root_entry < kNever) stack[size++] = {0, root_entry};
  while (size > 0) {
    const Entry top = stack[--size];
    // A hit found since this box was put aside may have made it superfluous.
    if (!SlabTest::is_before(top.t, t_max)) continue;
    const Node& node = nodes_[top.node];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i != node.first + node.count; ++i) {
        if (visit(spheres_[i])) return;
      }
      continue;
    }
    Entry near{node.first, slabs.entry(nodes_[node.first].box, t_max)};
    Entry far{node.first + 1, slabs.entry(nodes_[node.first + 1].box, t_max)};
    if (far.t < near.t) std::swap(near, far);
    if (far.t < kNever) stack[size++] = far;
    if (near.t < kNever) stack[size++] = near;
  }
}

template <class Meets, class Visit>
void Bvh::visit_where(Meets&& meets, Visit&& visit) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, kMaxDepth + 1> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (!meets(node.box)) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i != node.first + node.count; ++i) visit(spheres_[i]);
  }
}

}  // namespace tessera::render
