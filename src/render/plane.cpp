// SPDX-License-Identifier: BSD-3-Clause
#include "render/plane.h"

#include <cmath>

namespace tessera::render {
namespace {

Vec3 least_aligned_axis(const Vec3& n) noexcept {
  const Vec3 a{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
  if (a.x <= a.y && a.x <= a.z) return {1, 0, 0};
  return a.y <= a.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
}

}  // namespace

// The axis is chosen by the normal as given: normalising may make equal what is not.
CheckerAxes::CheckerAxes(const Plane& plane) noexcept {
  const Vec3 normal = normalized(plane.normal);
  u = normalized(cross(least_aligned_axis(plane.normal), normal));
  v = cross(normal, u);
}

Cell board_cell_at(const Plane& plane, const Vec3& point) noexcept {
  const CheckerAxes axes(plane);
  const Vec3 offset = point - plane.point;
  const double size = plane.checker->size;
  const double cell = std::floor(dot(offset, axes.u) / size) + std::floor(dot(offset, axes.v) / size);
  // fmod, not a cast: far out the cell number leaves the range of every integer type.
  return std::fmod(cell, 2) == 0 ? Cell::even : Cell::odd;
}

}  // namespace tessera::render
