// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <experimental/simd>

// Vectors of float lanes, one lane a ray; one lane is a plain float. In its own namespace, so that nothing here is ever
// mistaken for the renderer's own arithmetic.
namespace tessera::embree {

namespace stdx = std::experimental;

template <std::size_t W>
using Lanes = stdx::simd<float, stdx::simd_abi::deduce_t<float, W>>;
template <std::size_t W>
using LaneMask = typename Lanes<W>::mask_type;

template <class F>
struct Triple {
  F x{}, y{}, z{};

  friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Triple operator*(const Triple& a, const Triple& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend Triple operator*(const F& s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
  Triple& operator+=(const Triple& o) { return *this = *this + o; }
};

template <class F>
F dot(const Triple<F>& a, const Triple<F>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class F>
Triple<F> normalized(const Triple<F>& a) {
  using std::sqrt;
  return (F(1) / sqrt(dot(a, a))) * a;
}

/// The same vector in every lane.
template <std::size_t W>
Triple<Lanes<W>> broadcast(const Triple<float>& a) {
  return {Lanes<W>(a.x), Lanes<W>(a.y), Lanes<W>(a.z)};
}

/// `value` where the mask is set, 0 elsewhere.
template <class F>
F masked(const typename F::mask_type& mask, F value) {
  stdx::where(!mask, value) = 0;
  return value;
}

/// base^exponent for whole exponents, by squaring.
template <class F>
F whole_power(F base, F exponent) {
  F power = 1;
  for (auto rest = stdx::static_simd_cast<int>(exponent); stdx::any_of(rest > 0); rest >>= 1) {
    power = stdx::static_simd_cast<F>(rest & 1) * (base - 1) * power + power;
    base *= base;
  }
  return power;
}

}  // namespace tessera::embree
