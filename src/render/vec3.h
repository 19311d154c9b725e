// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

// Points and vectors of the scene in double precision. Nothing here fuses a multiply with an add.
namespace tessera::render {

/// A point or a vector with three components.
/// units:   world units
struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend constexpr bool operator==(const Vec3&, const Vec3&) noexcept = default;

  double operator[](int axis) const noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
};

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(const Vec3& a) noexcept {
  return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(const Vec3& a, double s) noexcept {
  return {a.x * s, a.y * s, a.z * s};
}
constexpr Vec3 operator*(double s, const Vec3& a) noexcept {
  return a * s;
}
constexpr Vec3 operator/(const Vec3& a, double s) noexcept {
  return {a.x / s, a.y / s, a.z / s};
}

constexpr double dot(const Vec3& a, const Vec3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// |x| + |y| + |z|, which is at least the length.
inline double sum_of_sizes(const Vec3& a) noexcept {
  return std::abs(a.x) + std::abs(a.y) + std::abs(a.z);
}
inline double largest_component(const Vec3& a) noexcept {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

/// Whether products of a few vectors with this squared length neither vanish nor overflow.
inline bool is_squarable(double squared_length) noexcept {
  return squared_length > 0x1p-200 && squared_length < 0x1p200;
}

/// 2^k a, k being such that the largest component is from 1/2 to 1. Rounds nothing but what vanishes beside it.
inline Vec3 rescaled(const Vec3& a, int& k) noexcept {
  std::frexp(largest_component(a), &k);
  k = -k;
  return {std::ldexp(a.x, k), std::ldexp(a.y, k), std::ldexp(a.z, k)};
}

/// For vectors of any length, 0 too.
inline double length(const Vec3& a) noexcept {
  const double squared = dot(a, a);
  if (is_squarable(squared)) return std::sqrt(squared);
  int k = 0;
  const Vec3 b = rescaled(a, k);
  return std::ldexp(std::sqrt(dot(b, b)), -k);
}
/// For vectors of any length other than 0.
inline Vec3 normalized(const Vec3& a) noexcept {
  const double squared = dot(a, a);
  if (is_squarable(squared)) return a / std::sqrt(squared);
  int k = 0;
  const Vec3 b = rescaled(a, k);
  return b / std::sqrt(dot(b, b));
}
inline bool is_finite(const Vec3& a) noexcept {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace tessera::render
