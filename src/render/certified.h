// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/exact.h"

namespace tessera::render {

/// A number in twice the precision of double that carries a bound on its own error, so that what it says of a sign is
/// certain. The second stage of every exact decision: it settles all but ties and differences below some 2^-100.
/// source:  Joldes, Muller, Popescu, Tight and rigorous error bounds for basic building blocks of double-word
///          arithmetic (2017), for the bounds of + and *; running error analysis after Wilkinson
class Certified {
 public:
  Certified(double exact) noexcept : value_{exact, 0} {}  // NOLINT: a double is one exactly

  friend Certified operator+(const Certified& a, const Certified& b) noexcept {
    const TwoTerm high = two_sum(a.value_.hi, b.value_.hi);
    const TwoTerm low = two_sum(a.value_.lo, b.value_.lo);
    const TwoTerm partial = quick_two_sum(high.hi, high.lo + low.hi);
    const TwoTerm sum = quick_two_sum(partial.hi, partial.lo + low.lo);
    return {sum, a.error_ + b.error_ + 4 * kSquaredUnit * std::abs(sum.hi)};
  }
  friend Certified operator-(const Certified& a) noexcept { return {{-a.value_.hi, -a.value_.lo}, a.error_}; }
  friend Certified operator-(const Certified& a, const Certified& b) noexcept { return a + -b; }
  friend Certified operator*(const Certified& a, const Certified& b) noexcept {
    if (a.is_zero() || b.is_zero()) return 0.0;
    const TwoTerm high = two_prod(a.value_.hi, b.value_.hi);
    const double cross = a.value_.hi * b.value_.lo + a.value_.lo * b.value_.hi;
    const TwoTerm product = quick_two_sum(high.hi, high.lo + cross);
    const double of_a = std::abs(a.value_.hi) * (1 + 4 * kUnitRoundoff);
    const double of_b = std::abs(b.value_.hi) * (1 + 4 * kUnitRoundoff);
    const double inherited = of_a * b.error_ + of_b * a.error_ + a.error_ * b.error_;
    return {product, inherited + 8 * kSquaredUnit * std::abs(product.hi) + kUnderflow};
  }

  /// The root of a number that is known to be >= 0, whatever this approximation says.
  friend Certified root_of(const Certified& a) noexcept {
    const double hi = a.value_.hi;
    // Too close to 0 for a relative statement: the root lies between 0 and that of the upper end.
    if (!(hi > 4 * a.error_)) return {{0, 0}, 2 * std::sqrt(std::max(hi, 0.0) + a.error_)};
    const double root = std::sqrt(hi);
    const TwoTerm square = two_prod(root, root);
    const double rest = ((hi - square.hi) - square.lo) + a.value_.lo;
    const TwoTerm refined = quick_two_sum(root, rest / (2 * root));
    return {refined, (a.error_ + kUnderflow) / root + 8 * kSquaredUnit * root};
  }

  /// -1, 0 or +1 where that is certain.
  std::optional<int> sign() const noexcept {
    if (value_.hi > error_) return 1;
    if (value_.hi < -error_) return -1;
    return is_zero() ? std::optional(0) : std::nullopt;
  }

 private:
  static constexpr double kSquaredUnit = kUnitRoundoff * kUnitRoundoff;
  /// More than underflow can take from the few products of one operation.
  static constexpr double kUnderflow = 0x1p-1070;

  /// The bound itself is rounded a few times on its way.
  Certified(const TwoTerm& value, double error) noexcept : value_(value), error_(error * (1 + 16 * kUnitRoundoff)) {}

  bool is_zero() const noexcept { return value_.hi == 0 && error_ == 0; }

  TwoTerm value_;
  double error_ = 0;
};

}  // namespace tessera::render
