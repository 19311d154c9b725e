// SPDX-License-Identifier: BSD-3-Clause
#include "render/power.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "render/exact.h"

namespace tessera::render {
namespace {

/// By squaring: at most `exponent` roundings of relative size u take part.
double whole_power(double base, std::uint64_t exponent) noexcept {
  double result = 1;
  for (double square = base; exponent > 0; exponent >>= 1, square *= square) {
    if ((exponent & 1) != 0) result *= square;
  }
  return result;
}

/// The series sum of terms(k) x^k, k = 0 .. Count - 1, by Horner's rule.
template <int Count, class Term>
double series(double x, Term term) noexcept {
  double sum = term(Count - 1);
  for (int k = Count - 2; k >= 0; --k) sum = sum * x + term(k);
  return sum;
}

/// 1 / k! for k = 0 .. 19, each the nearest double.
constexpr auto kInverseFactorial = [] {
  std::array<double, 20> inverse{};
  double factorial = 1;
  for (int k = 0; k != 20; ++k) {
    if (k > 0) factorial *= k;
    inverse[static_cast<std::size_t>(k)] = 1 / factorial;
  }
  return inverse;
}();

double inverse_factorial(int k) noexcept {
  return kInverseFactorial[static_cast<std::size_t>(k)];
}

/// log2(m) by 2 atanh(s) / ln 2 with s = (m - 1) / (m + 1), |s| <= 0.172; the next term is below 1e-18.
/// shapes:  m in [sqrt(1/2), sqrt(2)]
double log2_near_one(double m) noexcept {
  const double s = (m - 1) / (m + 1);
  return 2 * std::numbers::log2e * s * series<12>(s * s, [](int k) { return 1.0 / (2 * k + 1); });
}

/// 2^x; the next term is below 1e-18.
/// shapes:  |x| <= 1/2
double exp2_near_zero(double x) noexcept {
  return series<15>(x * std::numbers::ln2, inverse_factorial);
}

/// base^exponent by 2^(exponent log2 base), the logarithm split so that nothing large is rounded.
/// shapes:  base > 0, exponent in (0, 1)
double fractional_power(double base, double exponent) noexcept {
  int binade = 0;
  double m = std::frexp(base, &binade);
  if (m < std::numbers::sqrt2 / 2) {
    m *= 2;
    --binade;
  }
  const TwoTerm scaled = two_prod(exponent, binade);
  const double whole = std::floor(scaled.hi + 0.5);
  const double rest = (scaled.hi - whole) + (scaled.lo + exponent * log2_near_one(m));
  const double step = std::floor(rest + 0.5);
  return std::ldexp(exp2_near_zero(rest - step), static_cast<int>(whole + step));
}

/// Sine and cosine of at most 45 degrees by their series.
double sine(double x) noexcept {
  return x * series<9>(x * x, [](int k) { return (k % 2 == 0 ? 1 : -1) * inverse_factorial(2 * k + 1); });
}
double cosine(double x) noexcept {
  return series<10>(x * x, [](int k) { return (k % 2 == 0 ? 1 : -1) * inverse_factorial(2 * k); });
}

}  // namespace

double power(double base, double exponent) noexcept {
  if (exponent == 0 || base == 1) return 1;
  if (base == 0) return 0;
  // Beyond 2^63 the nearest numbers below and above 1 have long left the range.
  if (exponent >= 0x1p63) return base < 1 ? 0 : std::numeric_limits<double>::infinity();
  const double whole = std::floor(exponent);
  const double result = whole_power(base, static_cast<std::uint64_t>(whole));
  return exponent == whole ? result : result * fractional_power(base, exponent - whole);
}

double tangent_of_degrees(double degrees) noexcept {
  constexpr double kRadians = std::numbers::pi / 180;
  // 90 - degrees is exact from 45 on.
  if (degrees > 45) {
    const double rest = (90 - degrees) * kRadians;
    return cosine(rest) / sine(rest);
  }
  const double x = degrees * kRadians;
  return sine(x) / cosine(x);
}

}  // namespace tessera::render
