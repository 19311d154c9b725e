// SPDX-License-Identifier: BSD-3-Clause
#include "render/box.h"

#include <algorithm>
#include <cmath>

#include "render/exact.h"
#include "render/scene_data.h"

namespace tessera::render {

void Box::include(const Box& other) noexcept {
  lo = {std::min(lo.x, other.lo.x), std::min(lo.y, other.lo.y), std::min(lo.z, other.lo.z)};
  hi = {std::max(hi.x, other.hi.x), std::max(hi.y, other.hi.y), std::max(hi.z, other.hi.z)};
}

bool Box::contains(const Vec3& p) const noexcept {
  return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
}

double Box::reach_from(const Vec3& p) const noexcept {
  const Vec3 a = p - lo;
  const Vec3 b = hi - p;
  return std::max(a.x, b.x) + std::max(a.y, b.y) + std::max(a.z, b.z);
}

namespace {

/// Without the last step, which is monotonic: of many spheres it can wait until the end.
Box unrounded_bounds_of(const Vec3& center, double radius) noexcept {
  // A computed hit may belong to a sphere larger by some 10u.
  const double wide = radius * (1 + 64 * kUnitRoundoff);
  const Vec3 reach{wide, wide, wide};
  return {center - reach, center + reach};
}

Box rounded_outward(const Box& box) noexcept {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const auto down = [](double x) { return std::nextafter(x, -kInf); };
  const auto up = [](double x) { return std::nextafter(x, kInf); };
  return {{down(box.lo.x), down(box.lo.y), down(box.lo.z)}, {up(box.hi.x), up(box.hi.y), up(box.hi.z)}};
}

}  // namespace

Box bounds_of(const Vec3& center, double radius) noexcept {
  return rounded_outward(unrounded_bounds_of(center, radius));
}

Box hittable_bounds(std::span<const Sphere> spheres) noexcept {
  Box box;
  for (const Sphere& sphere : spheres) {
    if (sphere.radius > 0) box.include(unrounded_bounds_of(sphere.center, sphere.radius));
  }
  return box.is_empty() ? box : rounded_outward(box);
}

}  // namespace tessera::render
