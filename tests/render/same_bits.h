// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <optional>

#include "render/color.h"
#include "render/ray.h"

// Equality as kernels promise it: 0 and -0 are two numbers.
namespace tessera::render::test {

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
inline bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}
inline bool same_bits(const Rgb& a, const Rgb& b) {
  return same_bits(a.r, b.r) && same_bits(a.g, b.g) && same_bits(a.b, b.b);
}
inline bool same_bits(const SurfacePoint& a, const SurfacePoint& b) {
  return a.surface == b.surface && same_bits(a.point, b.point) && same_bits(a.normal, b.normal);
}
inline bool same_bits(const Hit& a, const Hit& b) {
  return same_bits(a.t, b.t) && same_bits(static_cast<const SurfacePoint&>(a), static_cast<const SurfacePoint&>(b));
}
/// Of two points, or of a point and what a single ray found.
inline bool same_bits(const std::optional<SurfacePoint>& a, const std::optional<Hit>& b) {
  return a && b ? same_bits(*a, static_cast<const SurfacePoint&>(*b)) : !a && !b;
}
inline bool same_bits(const std::optional<SurfacePoint>& a, const std::optional<SurfacePoint>& b) {
  return a && b ? same_bits(*a, *b) : !a && !b;
}
inline bool same_bits(const std::optional<Hit>& a, const std::optional<Hit>& b) {
  return a && b ? same_bits(*a, *b) : !a && !b;
}

}  // namespace tessera::render::test
