// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/exact.h"
#include "render/lanes_avx2.h"
#include "render/vec3_lanes.h"

#if defined(__x86_64__)

// vec3.h and exact.h on four vectors at once: the same operations in the same order, so the same bits.
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {

/// Four vectors.
struct Vec3x4 {
  Double4 x;
  Double4 y;
  Double4 z;

  static Vec3x4 load(const Vec3Lanes& a) noexcept {
    return {Double4::load(a.x), Double4::load(a.y), Double4::load(a.z)};
  }
  static Vec3x4 all(const Vec3& a) noexcept { return {Double4::all(a.x), Double4::all(a.y), Double4::all(a.z)}; }
  static Vec3x4 of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
    return {Double4::of(a.x, b.x, c.x, d.x), Double4::of(a.y, b.y, c.y, d.y), Double4::of(a.z, b.z, c.z, d.z)};
  }
  void store(Vec3Lanes& a) const noexcept {
    x.store(a.x);
    y.store(a.y);
    z.store(a.z);
  }
};

inline Vec3x4 operator+(const Vec3x4& a, const Vec3x4& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3x4 operator-(const Vec3x4& a, const Vec3x4& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3x4 operator-(const Vec3x4& a) noexcept {
  return {-a.x, -a.y, -a.z};
}
inline Vec3x4 operator*(Double4 s, const Vec3x4& a) noexcept {
  return {a.x * s, a.y * s, a.z * s};
}
inline Vec3x4 operator/(const Vec3x4& a, Double4 s) noexcept {
  return {a.x / s, a.y / s, a.z / s};
}
inline Vec3x4 where(Mask4 mask, const Vec3x4& a, const Vec3x4& b) noexcept {
  return {where(mask, a.x, b.x), where(mask, a.y, b.y), where(mask, a.z, b.z)};
}
inline Double4 dot(const Vec3x4& a, const Vec3x4& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3x4 cross(const Vec3x4& a, const Vec3x4& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Mask4 are_squarable(Double4 squared_length) noexcept {
  return (Double4::all(0x1p-200) < squared_length) & (squared_length < Double4::all(0x1p200));
}

struct TwoTerm4 {
  Double4 hi;
  Double4 lo;
};
inline TwoTerm4 two_sum(Double4 a, Double4 b) noexcept {
  const Double4 hi = a + b;
  const Double4 b_part = hi - a;
  return {hi, (a - (hi - b_part)) + (b - b_part)};
}
inline TwoTerm4 two_diff(Double4 a, Double4 b) noexcept {
  return two_sum(a, -b);
}
inline Double4 difference_of_products(Double4 a, Double4 b, Double4 c, Double4 d) noexcept {
  const Double4 cd = c * d;
  const Double4 cd_error = fused_minus(c, d, cd);
  return fused_less(a, b, cd) + cd_error;
}
inline Vec3x4 exact_cross(const Vec3x4& a, const Vec3x4& b) noexcept {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

struct ExactDifference4 {
  Vec3x4 hi;
  Vec3x4 lo;
};
inline ExactDifference4 exact_difference(const Vec3x4& a, const Vec3x4& b) noexcept {
  const TwoTerm4 x = two_diff(a.x, b.x);
  const TwoTerm4 y = two_diff(a.y, b.y);
  const TwoTerm4 z = two_diff(a.z, b.z);
  return {{x.hi, y.hi, z.hi}, {x.lo, y.lo, z.lo}};
}

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#endif
