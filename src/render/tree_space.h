// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/box.h"
#include "render/ray.h"

// The tree's own coordinates, in float. They are only ever used to leave out what cannot be hit: everything is rounded
// to the side on which too much is looked at.
namespace tessera::render {

/// Scene coordinates relative to a point among the spheres, in units in which the spheres reach about 1 from there.
/// Floats are finest around the base, so it should be where most of the spheres are.
struct TreeSpace {
  /// More than a float's rounding of a coordinate x takes: kRounding |x| + kFloor, the second for numbers near 0.
  static constexpr double kRounding = 0x1p-23;
  static constexpr double kFloor = 0x1p-40;

  Vec3 base;
  double scale = 1;   ///< a power of two
  Vec3 middle;        ///< of all spheres, in tree space
  double extent = 0;  ///< every sphere is within this distance from the middle, in tree space

  Vec3 from_scene(const Vec3& p) const noexcept { return (p - base) * scale; }
  Vec3 to_scene(const Vec3& p) const noexcept { return p / scale + base; }

  static float down(double x) noexcept { return static_cast<float>(x - (std::abs(x) * kRounding + kFloor)); }
  static float up(double x) noexcept { return static_cast<float>(x + (std::abs(x) * kRounding + kFloor)); }
};

/// A ray as the tree sees it.
///
/// error:   boxes: the near side of a slab is taken from an origin that is rounded towards it, the far side from one
///          rounded away, so both differences err outward; three roundings of each distance are within kSlack.
///          spheres: with M = |C| + |O| (sums of sizes), the perpendicular from the centre to the line is off by less
///          than 17 2^-24 M: 4.4 from rounding and subtracting C and O, 12 from rounding the direction, the foot and
///          the products. 2^-19 M outweighs it; its part from C is counted with the sphere, that from O with the ray
struct TreeRay {
  static constexpr float kSlack = 1 + 0x1p-20F;
  static constexpr double kSphereError = 0x1p-19;
  /// An origin that is not known to this is not known at all: then every box and every sphere is looked at.
  static constexpr double kFarthest = 0x1p30;

  /// A huge finite reciprocal says without 0 * infinity that a ray along a slab is inside of it for all t or for none.
  static constexpr double kLargestInverse = 0x1p100;

  // By axis, and a lane to spare.
  float near_origin[4];
  float far_origin[4];
  float inverse[4];  ///< of the direction
  float origin[4];
  float direction[4];     ///< of length 1
  unsigned near_side[3];  ///< 0: a box's low side is met first, 1: its high side
  float sphere_error;     ///< the ray's share of what the distance of a centre from the line may be off by
  double t_scale;         ///< t of the tree is t_scale t - t_shift, or a little less
  double t_shift;

  /// What the members are computed from.
  struct Start {
    Vec3 origin;   ///< in tree space
    Vec3 unit;     ///< direction
    double shift;  ///< how far along the ray the origin was moved
    double off;    ///< by how much that may have misplaced it
  };

  TreeRay() = default;
  /// units:   inverse_length is 1 / |ray.direction|
  TreeRay(const TreeSpace& space, const Ray& ray, double inverse_length) noexcept {
    const Start start = start_of(space, ray, inverse_length);
    for (int axis = 0; axis != 3; ++axis) {
      const double x = std::clamp(start.origin[axis], -kFarthest, kFarthest);
      const double d = start.unit[axis];
      const float up = TreeSpace::up(std::min(x + start.off, kFarthest));
      const float down = TreeSpace::down(std::max(x - start.off, -kFarthest));
      const bool forward = !std::signbit(d);
      near_origin[axis] = forward ? up : down;
      far_origin[axis] = forward ? down : up;
      near_side[axis] = forward ? 0 : 1;
      inverse[axis] = static_cast<float>(std::clamp(1 / d, -kLargestInverse, kLargestInverse));
      origin[axis] = static_cast<float>(x);
      direction[axis] = static_cast<float>(d);
    }
    set_scalars(space, start, inverse_length);
  }

  static Start start_of(const TreeSpace& space, const Ray& ray, double inverse_length) noexcept {
    Start start{space.from_scene(ray.origin), ray.direction * inverse_length, 0, 0};
    // From far away, begin where the spheres do: what is far from the base rounds coarsely.
    const Vec3 way = space.middle - start.origin;
    const double squared = dot(way, way);
    if (squared > 16 * space.extent * space.extent) {
      start.shift = std::sqrt(squared) - 1.001 * space.extent;
      start.off = 0x1p-50 * (sum_of_sizes(start.origin) + start.shift);
      start.origin = start.origin + start.shift * start.unit;
    }
    return start;
  }

  void set_scalars(const TreeSpace& space, const Start& start, double inverse_length) noexcept {
    sphere_error = TreeSpace::up(std::min(kSphereError * sum_of_sizes(start.origin) + 4 * start.off, 4 * kFarthest) +
                                 4 * TreeSpace::kFloor);
    t_scale = space.scale / inverse_length * (1 + 0x1p-50);
    t_shift = start.shift * (1 - 0x1p-50);
  }

  /// Scene distances in the tree's units, rounded up.
  float t_of(double t) const noexcept {
    return std::min(TreeSpace::up(t * t_scale - t_shift), std::numeric_limits<float>::max());
  }
  /// The same, rounded down: both scale and shift are known to 2^-50 and their own rounding.
  float least_t_of(double t) const noexcept {
    const double least = t * (t_scale * (1 - 0x1p-48)) - t_shift * (1 + 0x1p-48);
    return TreeSpace::down(std::min(least, 0x1p120));
  }
};

}  // namespace tessera::render
