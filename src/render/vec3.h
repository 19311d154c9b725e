// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
inline double length(const Vec3& a) noexcept {
  return std::sqrt(dot(a, a));
}
inline Vec3 normalized(const Vec3& a) noexcept {
  return a / length(a);
}
inline bool is_finite(const Vec3& a) noexcept {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace tessera::render
