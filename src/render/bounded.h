// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/exact.h"

// Rounded numbers that know how far off they may be: the first stage of every exact decision.
namespace tessera::render {

/// shapes:  |value - exact| <= error
struct Bounded {
  double value = 0;
  double error = 0;

  /// The sign of the exact number; `exactly` is asked where the rounded one cannot tell.
  template <class Exactly>
  int sign_or(Exactly&& exactly) const noexcept {
    return value > error ? 1 : value < -error ? -1 : exactly();
  }
};

/// f.d for an exact f.
/// error:   a sum of three products in twice the precision, rounded once; Ogita, Rump, Oishi (2005), prop. 5.5
inline Bounded bounded_dot(const ExactDifference& f, const Vec3& d) noexcept {
  CompensatedSum sum;
  sum.add_product(f.hi.x, d.x);
  sum.add_product(f.hi.y, d.y);
  sum.add_product(f.hi.z, d.z);
  sum.add_small(dot(f.lo, d));
  const double value = sum.value();
  const double terms = std::abs(f.hi.x * d.x) + std::abs(f.hi.y * d.y) + std::abs(f.hi.z * d.z);
  return {value, kUnitRoundoff * std::abs(value) + 32 * kUnitRoundoff * kUnitRoundoff * terms};
}

/// f.f - r^2 for an exact f: with f = C - P the power of the point P against a sphere, < 0 inside, 0 on, > 0 outside.
/// error:   as above, of seven products
inline Bounded bounded_power(const ExactDifference& f, double radius) noexcept {
  CompensatedSum power;
  power.add_product(f.hi.x, f.hi.x);
  power.add_product(f.hi.y, f.hi.y);
  power.add_product(f.hi.z, f.hi.z);
  power.add_product(-radius, radius);
  power.add_small(2 * dot(f.hi, f.lo));
  const double value = power.value();
  const double terms = dot(f.hi, f.hi) + radius * radius;
  return {value, kUnitRoundoff * std::abs(value) + 64 * kUnitRoundoff * kUnitRoundoff * terms};
}

/// n / d for d > 0, with the bound that follows from theirs; infinite where d is hardly known.
inline Bounded bounded_quotient(const Bounded& n, const Bounded& d) noexcept {
  const double quotient = n.value / d.value;
  const double inverse = 1 / d.value;  // good enough for the bound
  const double relative = d.error * inverse + 4 * kUnitRoundoff;
  if (!(relative < 0.25)) return {quotient, std::numeric_limits<double>::infinity()};
  return {quotient, 2 * (n.error * inverse + std::abs(quotient) * relative)};
}

/// A number that is known not to be below 0, whatever rounding says.
inline Bounded not_negative(const Bounded& a) noexcept {
  return {std::max(a.value, 0.0), a.error};
}

}  // namespace tessera::render
