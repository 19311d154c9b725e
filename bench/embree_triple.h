// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/color.h"
#include "render/vec3.h"

// Vectors and colours of any kind of number. In a namespace of its own, so that nothing here is ever mistaken for the
// renderer's arithmetic.
namespace tessera::embree {

template <class F>
struct Triple {
  F x{}, y{}, z{};

  friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Triple operator*(const Triple& a, const Triple& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend Triple operator*(const F& s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
  Triple& operator+=(const Triple& o) { return *this = *this + o; }
};

inline Triple<float> to_float(const render::Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

inline Triple<float> to_float(const render::Rgb& c) {
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
}

}  // namespace tessera::embree
