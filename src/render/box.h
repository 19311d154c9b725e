// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "render/ray.h"

namespace tessera::render {

struct Sphere;

/// An axis-aligned box.
struct Box {
  Vec3 lo{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::infinity()};
  Vec3 hi{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()};

  void include(const Box& other) noexcept;
  bool is_empty() const noexcept { return !(lo.x <= hi.x); }
  bool contains(const Vec3& p) const noexcept;
  /// The distance from `p` to the corner that is farthest from it, summed over the axes.
  double reach_from(const Vec3& p) const noexcept;
};

/// The box of a sphere, a little wider than the sphere: whatever sphere.h computes as hit lies inside.
Box bounds_of(const Vec3& center, double radius) noexcept;

/// The box of all spheres whose radius is not 0: of those that can be hit.
Box hittable_bounds(std::span<const Sphere> spheres) noexcept;

/// A ray prepared for box tests: reciprocal direction, and per axis which side of a box is the near one.
class SlabTest {
 public:
  explicit SlabTest(const Ray& ray) noexcept
      : origin_(ray.origin), inverse_{inverse(ray.direction.x), inverse(ray.direction.y), inverse(ray.direction.z)} {}

  /// Where the ray enters the box, or infinity where it passes it or enters after `t_max`.
  /// error:   the slack covers the roundings of three slabs and of a sphere's t, so no hit before `t_max` is lost
  double entry(const Box& box, double t_max) const noexcept {
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    clip(box.lo.x, box.hi.x, origin_.x, inverse_.x, enter, leave);
    clip(box.lo.y, box.hi.y, origin_.y, inverse_.y, enter, leave);
    clip(box.lo.z, box.hi.z, origin_.z, inverse_.z, enter, leave);
    const bool met = enter <= leave * kSlack && enter <= t_max * kSlack;
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

}  // namespace tessera::render
