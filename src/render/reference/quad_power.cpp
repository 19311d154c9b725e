// SPDX-License-Identifier: BSD-3-Clause
#include "render/reference/quad_power.h"

#include <cmath>
#include <cstdint>

namespace tessera::render::reference {
namespace {

/// By squaring.
Quad whole_power(Quad base, std::uint64_t exponent) {
  Quad result = 1;
  for (Quad square = base; exponent > 0; exponent >>= 1, square *= square) {
    if ((exponent & 1) != 0) result *= square;
  }
  return result;
}

/// ln a = -2 atanh(s), s = (1 - a) / (1 + a), for a near 1.
/// shapes:  a in [1/2, 1], so s <= 1/3; the terms fall by 9 at least, and 36 of them reach 2^-113
Quad log_near_one(Quad a) {
  const Quad s = (1 - a) / (1 + a);
  Quad sum = 0;
  for (int k = 38; k >= 0; --k) sum = sum * s * s + Quad(1) / (2 * k + 1);
  return -2 * s * sum;
}

/// e^x by its series at x / 256, squared eight times.
/// shapes:  x in [-1, 0]
Quad exponential(Quad x) {
  const Quad small = x / 256;
  Quad sum = 1;
  for (int k = 20; k >= 1; --k) sum = 1 + sum * small / k;
  for (int i = 0; i != 8; ++i) sum *= sum;
  return sum;
}

}  // namespace

Quad quad_power(Quad base, double exponent) {
  if (exponent == 0 || base == 1) return 1;
  if (!(base > 0)) return 0;
  // Beyond 2^63 any base below 1 that 113 bits can say has long left the range.
  if (exponent >= 0x1p63) return 0;
  const double whole = std::floor(exponent);
  Quad result = whole_power(base, static_cast<std::uint64_t>(whole));
  // The fraction of the exponent: halve the logarithm's argument until it is near 1.
  const double fraction = exponent - whole;
  if (fraction == 0 || !(result > 0)) return result;
  const Quad log_of_two = -log_near_one(0.5);
  Quad mantissa = base;
  int halvings = 0;
  for (; mantissa < 0.5; mantissa *= 2) ++halvings;
  Quad rest = fraction * (log_near_one(mantissa) - halvings * log_of_two);
  for (; rest < -log_of_two; rest += log_of_two) result /= 2;
  return result * exponential(rest);
}

}  // namespace tessera::render::reference
