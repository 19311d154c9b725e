// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "render/vec3.h"

// Arithmetic that keeps what rounding throws away. Every function is exact or states its error.
namespace tessera::render {

/// The unit roundoff u of double: half a unit in the last place of 1.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// A number as an unevaluated sum of two doubles, |lo| <= u |hi|.
struct TwoTerm {
  double hi = 0;
  double lo = 0;
};

/// hi + lo = a + b exactly.
/// source:  Knuth, The Art of Computer Programming 2 (1969), 4.2.2
inline TwoTerm two_sum(double a, double b) noexcept {
  const double hi = a + b;
  const double b_part = hi - a;
  return {hi, (a - (hi - b_part)) + (b - b_part)};
}

/// hi + lo = a + b exactly, for |a| >= |b| or a = 0.
/// source:  Dekker, A floating-point technique for extending the available precision (1971)
inline TwoTerm quick_two_sum(double a, double b) noexcept {
  const double hi = a + b;
  return {hi, b - (hi - a)};
}

/// hi + lo = a - b exactly.
inline TwoTerm two_diff(double a, double b) noexcept {
  return two_sum(a, -b);
}

/// hi + lo = a b exactly, underflow aside.
inline TwoTerm two_prod(double a, double b) noexcept {
  const double hi = a * b;
  return {hi, std::fma(a, b, -hi)};
}

/// a b - c d.
/// error:   <= 1.5 ulp of the result, however much cancels
/// source:  Jeannerod, Louvet, Muller, Further analysis of Kahan's algorithm for 2 x 2 determinants (2013)
inline double difference_of_products(double a, double b, double c, double d) noexcept {
  const double cd = c * d;
  const double cd_error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + cd_error;
}

/// a x b, each component by difference_of_products.
inline Vec3 exact_cross(const Vec3& a, const Vec3& b) noexcept {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

/// A running sum of products, as accurate as if computed in twice the precision and rounded once.
/// source:  Ogita, Rump, Oishi, Accurate sum and dot product (2005), algorithm Dot2
class CompensatedSum {
 public:
  void add_product(double a, double b) noexcept {
    const TwoTerm product = two_prod(a, b);
    const TwoTerm sum = two_sum(sum_, product.hi);
    sum_ = sum.hi;
    rest_ += sum.lo + product.lo;
  }
  void add_small(double a) noexcept { rest_ += a; }  ///< for terms that are themselves corrections
  double value() const noexcept { return sum_ + rest_; }

 private:
  double sum_ = 0;
  double rest_ = 0;
};

/// A vector difference a - b as hi + lo, exact in every component.
struct ExactDifference {
  Vec3 hi;
  Vec3 lo;
};

inline ExactDifference exact_difference(const Vec3& a, const Vec3& b) noexcept {
  const TwoTerm x = two_diff(a.x, b.x);
  const TwoTerm y = two_diff(a.y, b.y);
  const TwoTerm z = two_diff(a.z, b.z);
  return {{x.hi, y.hi, z.hi}, {x.lo, y.lo, z.lo}};
}

}  // namespace tessera::render
