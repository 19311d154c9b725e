// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "render/vec3.h"

// Quad precision (113 bits) as an oracle for double: products of two doubles are exact in it. Operators only, for not
// every compiler has a library for it.
namespace tessera::render::reference {

__extension__ typedef __float128 Quad;

constexpr Quad magnitude(Quad a) {
  return a < 0 ? -a : a;
}

/// Three Newton steps from the double root; 0 for what is not positive.
inline Quad square_root(Quad a) {
  if (!(a > 0)) return 0;
  if (a < 0x1p-1000) return square_root(a * 0x1p1000) * 0x1p-500;
  if (a > 0x1p1000) return square_root(a * 0x1p-1000) * 0x1p500;
  Quad root = std::sqrt(static_cast<double>(a));
  for (int step = 0; step != 3; ++step) root = (root + a / root) / 2;
  return root;
}

struct QuadVec {
  Quad x = 0;
  Quad y = 0;
  Quad z = 0;

  constexpr QuadVec() = default;
  constexpr QuadVec(Quad ax, Quad ay, Quad az) : x(ax), y(ay), z(az) {}
  constexpr QuadVec(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}  // NOLINT: every Vec3 is exact here
};

constexpr QuadVec operator+(const QuadVec& a, const QuadVec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr QuadVec operator-(const QuadVec& a, const QuadVec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr QuadVec operator*(Quad s, const QuadVec& a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr Quad quad_dot(const QuadVec& a, const QuadVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr QuadVec quad_cross(const QuadVec& a, const QuadVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Quad quad_length(const QuadVec& a) {
  return square_root(quad_dot(a, a));
}
inline QuadVec quad_unit(const QuadVec& a) {
  return (1 / quad_length(a)) * a;
}

/// How a line meets a sphere, by the textbook's quadratic, which 113 bits can afford.
struct QuadLine {
  Quad a;             ///< d.d
  Quad b;             ///< f.d
  Quad discriminant;  ///< r^2 d.d - |f x d|^2

  QuadLine(const QuadVec& origin, const QuadVec& direction, const QuadVec& center, Quad radius) {
    const QuadVec f = center - origin;
    const QuadVec w = quad_cross(f, direction);
    a = quad_dot(direction, direction);
    b = quad_dot(f, direction);
    discriminant = radius * radius * a - quad_dot(w, w);
  }

  /// The two crossings; for a line that misses, its point nearest to the centre.
  Quad near() const { return (b - square_root(discriminant)) / a; }
  Quad far() const { return (b + square_root(discriminant)) / a; }
};

}  // namespace tessera::render::reference
