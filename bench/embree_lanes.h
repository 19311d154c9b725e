// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <experimental/simd>

#include "embree_triple.h"

// Eight rays at a time in single precision, a lane each.
namespace tessera::embree {

namespace stdx = std::experimental;

inline constexpr std::size_t kLanes = 8;
using Lanes = stdx::simd<float, stdx::simd_abi::deduce_t<float, kLanes>>;
using LaneMask = Lanes::mask_type;

using Wide = Triple<Lanes>;

inline Lanes dot(const Wide& a, const Wide& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Wide normalized(const Wide& a) {
  return (1.0F / sqrt(dot(a, a))) * a;
}

/// The same vector in every lane.
inline Wide broadcast(const Triple<float>& a) {
  return {Lanes(a.x), Lanes(a.y), Lanes(a.z)};
}

/// One lane of a vector.
inline void set(Wide& lanes, std::size_t i, const Triple<float>& value) {
  lanes.x[i] = value.x;
  lanes.y[i] = value.y;
  lanes.z[i] = value.z;
}

/// `value` where the mask is set, 0 elsewhere.
inline Lanes masked(const LaneMask& mask, Lanes value) {
  stdx::where(!mask, value) = 0;
  return value;
}

/// `b` where the mask is set, `a` elsewhere.
inline Wide chosen(const LaneMask& mask, Wide a, const Wide& b) {
  stdx::where(mask, a.x) = b.x;
  stdx::where(mask, a.y) = b.y;
  stdx::where(mask, a.z) = b.z;
  return a;
}

inline Lanes largest_component(const Wide& a) {
  return stdx::max(stdx::max(abs(a.x), abs(a.y)), abs(a.z));
}

/// base^exponent for whole exponents, by squaring.
inline Lanes whole_power(Lanes base, const Lanes& exponent) {
  Lanes power = 1;
  for (auto rest = stdx::static_simd_cast<int>(exponent); stdx::any_of(rest > 0); rest >>= 1) {
    power *= stdx::static_simd_cast<Lanes>(rest & 1) * (base - 1) + 1;
    base *= base;
  }
  return power;
}

}  // namespace tessera::embree
