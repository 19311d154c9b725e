// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmpxx.h>

#include <cmath>
#include <utility>

namespace tessera::render {

/// An exact number m 2^e: what sums and products of doubles are. The last stage of every exact decision, slow and
/// never wrong, whatever the range.
class Dyadic {
 public:
  /// requires: finite
  Dyadic(double value) {  // NOLINT: a double is one
    int exponent = 0;
    mantissa_ = std::ldexp(std::frexp(value, &exponent), 53);
    exponent_ = exponent - 53;
  }

  friend Dyadic operator+(const Dyadic& a, const Dyadic& b) {
    if (a.exponent_ < b.exponent_) return b + a;
    return {(a.mantissa_ << static_cast<mp_bitcnt_t>(a.exponent_ - b.exponent_)) + b.mantissa_, b.exponent_};
  }
  friend Dyadic operator-(const Dyadic& a) { return {-a.mantissa_, a.exponent_}; }
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + -b; }
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    return {a.mantissa_ * b.mantissa_, a.exponent_ + b.exponent_};
  }

  /// -1, 0 or +1.
  int sign() const { return sgn(mantissa_); }

 private:
  Dyadic(mpz_class mantissa, long exponent) : mantissa_(std::move(mantissa)), exponent_(exponent) {}

  mpz_class mantissa_;
  long exponent_ = 0;
};

}  // namespace tessera::render
