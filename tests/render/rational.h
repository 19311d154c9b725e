// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmpxx.h>

#include "render/vec3.h"

// Exact rational arithmetic as an oracle: slow, and never wrong.
namespace tessera::render::test {

struct RationalVec {
  mpq_class x;
  mpq_class y;
  mpq_class z;

  explicit RationalVec(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
};

inline mpq_class rational_dot(const RationalVec& a, const RationalVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline RationalVec rational_difference(const Vec3& a, const Vec3& b) {
  RationalVec v(a);
  v.x -= mpq_class(b.x);
  v.y -= mpq_class(b.y);
  v.z -= mpq_class(b.z);
  return v;
}

/// (f.d)^2 - d.d (f.f - r^2): the textbook's discriminant, which nothing is lost in here.
inline mpq_class rational_discriminant(const Vec3& origin, const Vec3& direction, const Vec3& center, double radius) {
  const RationalVec f = rational_difference(center, origin);
  const RationalVec d(direction);
  const mpq_class b = rational_dot(f, d);
  const mpq_class c = rational_dot(f, f) - mpq_class(radius) * mpq_class(radius);
  return b * b - rational_dot(d, d) * c;
}

}  // namespace tessera::render::test
