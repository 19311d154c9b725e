// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/box.h"
#include "render/scene_data.h"
#include "render/vec3.h"

namespace tessera::render {

/// Where a segment may truly run whose start and direction are known up to an error: each of its points, a way s from
/// the start, lies within position_error + direction_error s of where it is computed to be.
///
/// error:   what is called sure holds for every segment in the tube. The tests' own roundings stay below
///          16u (|f| + r), f being the vector from the start to the centre; that much is added to the tube.
class Tube {
 public:
  /// shapes:  direction is a unit vector; length may be infinite
  Tube(const Vec3& start, const Vec3& direction, double length, double position_error, double direction_error) noexcept;

  /// The segment runs outside of the sphere.
  bool surely_passes(const Vec3& center, double radius) const noexcept;
  /// The segment comes inside the sphere.
  bool surely_enters(const Vec3& center, double radius) const noexcept;
  /// The segment runs inside of the sphere.
  bool surely_stays_in(const Vec3& center, double radius) const noexcept;
  /// The segment runs on one side of a plane, +1 where the normal points to.
  bool surely_stays_beside(const Vec3& plane_point, const Vec3& unit_normal, int side) const noexcept;

  /// Whether the segment can reach into a box.
  bool may_meet(const Box& box) const noexcept;

 private:
  /// How far off a point may be that matters to a sphere, roundings included.
  double width_at(double center_distance, double radius) const noexcept;

  Vec3 start_;
  Vec3 direction_;
  double length_;
  double position_error_;
  double direction_error_;
  SlabTest slabs_;
};

}  // namespace tessera::render
