// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Linear RGB: a colour, a light's intensity or a radiance. Any value >= 0 is allowed.
namespace tessera::render {

/// units:   linear, 1 is the display's white
struct Rgb {
  double r = 0;
  double g = 0;
  double b = 0;

  friend constexpr bool operator==(const Rgb&, const Rgb&) noexcept = default;

  constexpr Rgb& operator+=(const Rgb& o) noexcept {
    r += o.r;
    g += o.g;
    b += o.b;
    return *this;
  }
};

constexpr Rgb operator+(Rgb a, const Rgb& b) noexcept {
  return a += b;
}
constexpr Rgb operator*(const Rgb& a, double s) noexcept {
  return {a.r * s, a.g * s, a.b * s};
}
constexpr Rgb operator*(double s, const Rgb& a) noexcept {
  return a * s;
}
constexpr Rgb operator*(const Rgb& a, const Rgb& b) noexcept {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}

}  // namespace tessera::render
