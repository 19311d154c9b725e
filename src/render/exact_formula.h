// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/certified.h"
#include "render/dyadic.h"
#include "render/vec3.h"

// A decision is the sign of a formula. The formula is written once, for any number type, and evaluated in twice the
// precision first and exactly only where that cannot tell.
namespace tessera::render {

/// A vector of any number type.
template <class Number>
struct VecOf {
  Number x;
  Number y;
  Number z;

  VecOf(Number ax, Number ay, Number az) : x(ax), y(ay), z(az) {}
  explicit VecOf(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
};

template <class Number>
VecOf<Number> difference(const Vec3& a, const Vec3& b) {
  return {Number(a.x) - b.x, Number(a.y) - b.y, Number(a.z) - b.z};
}
template <class Number>
Number dot(const VecOf<Number>& a, const VecOf<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Number>
VecOf<Number> cross(const VecOf<Number>& a, const VecOf<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The sign of `formula`, a callable with a template parameter for the number type.
template <class Formula>
int sign_of(const Formula& formula) {
  if (const auto sign = formula.template operator()<Certified>().sign()) return *sign;
  return formula.template operator()<Dyadic>().sign();
}

}  // namespace tessera::render
