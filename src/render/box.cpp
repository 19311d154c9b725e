// SPDX-License-Identifier: BSD-3-Clause
#include "render/box.h"

#include <algorithm>
#include <cmath>

#include "render/exact.h"

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

Box bounds_of(const Vec3& center, double radius) noexcept {
  // A computed hit may belong to a sphere larger by some 10u; then round each face outward.
  const double wide = radius * (1 + 64 * kUnitRoundoff);
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const auto down = [&](double x) { return std::nextafter(x - wide, -kInf); };
  const auto up = [&](double x) { return std::nextafter(x + wide, kInf); };
  return {{down(center.x), down(center.y), down(center.z)}, {up(center.x), up(center.y), up(center.z)}};
}

}  // namespace tessera::render
