// SPDX-License-Identifier: BSD-3-Clause
#include "render/tube.h"

#include <algorithm>
#include <cmath>

#include "render/exact.h"

namespace tessera::render {

Tube::Tube(const Vec3& start, const Vec3& direction, double length, double position_error,
           double direction_error) noexcept
    : start_(start),
      direction_(direction),
      length_(length),
      position_error_(position_error),
      direction_error_(direction_error),
      slabs_({.origin = start, .direction = direction}) {}

// No point further than |f| + r from the start is in the sphere, or nearest to its centre.
double Tube::width_at(double center_distance, double radius) const noexcept {
  const double reach = center_distance + radius;
  return position_error_ + direction_error_ * std::min(length_, reach) + 16 * kUnitRoundoff * reach;
}

bool Tube::surely_passes(const Vec3& center, double radius) const noexcept {
  const Vec3 f = center - start_;
  const double nearest = std::clamp(dot(f, direction_), 0.0, length_);
  return length(f - nearest * direction_) > radius + width_at(length(f), radius);
}

bool Tube::surely_enters(const Vec3& center, double radius) const noexcept {
  const Vec3 f = center - start_;
  const double nearest = std::clamp(dot(f, direction_), 0.0, length_);
  return length(f - nearest * direction_) < radius - width_at(length(f), radius);
}

// A sphere is convex: both ends tell.
bool Tube::surely_stays_in(const Vec3& center, double radius) const noexcept {
  const Vec3 f = center - start_;
  const double width = width_at(length(f), radius);
  return std::isfinite(length_) && length(f) < radius - width && length(f - length_ * direction_) < radius - width;
}

// The height over a plane is linear along the segment, and so is its error: both ends tell.
bool Tube::surely_stays_beside(const Vec3& plane_point, const Vec3& unit_normal, int side) const noexcept {
  const Vec3 f = start_ - plane_point;
  const double height = side * dot(f, unit_normal) - position_error_ - 16 * kUnitRoundoff * length(f);
  const double climb = side * dot(direction_, unit_normal) - direction_error_ - 16 * kUnitRoundoff;
  return height > 0 && (climb >= 0 || height + climb * length_ > 0);
}

bool Tube::may_meet(const Box& box) const noexcept {
  const Vec3 far{std::max(std::abs(box.lo.x - start_.x), std::abs(box.hi.x - start_.x)),
                 std::max(std::abs(box.lo.y - start_.y), std::abs(box.hi.y - start_.y)),
                 std::max(std::abs(box.lo.z - start_.z), std::abs(box.hi.z - start_.z))};
  const double width = width_at(length(far), 0);
  const Vec3 margin{width, width, width};
  return slabs_.entry({box.lo - margin, box.hi + margin}, length_) < std::numeric_limits<double>::infinity();
}

}  // namespace tessera::render
