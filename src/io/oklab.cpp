// SPDX-License-Identifier: BSD-3-Clause
#include "io/oklab.h"

#include <cmath>
#include <cstddef>

#include "render/encode.h"

namespace tessera::io {
namespace {

double linear_of(std::uint8_t channel) noexcept {
  return render::linear_from_srgb(channel / 255.0);
}

double cube(double x) noexcept {
  return x * x * x;
}

}  // namespace

Oklab oklab_of(const Rgb8& color) noexcept {
  const double red = linear_of(color[0]);
  const double green = linear_of(color[1]);
  const double blue = linear_of(color[2]);
  const double l = std::cbrt(0.4122214708 * red + 0.5363325363 * green + 0.0514459929 * blue);
  const double m = std::cbrt(0.2119034982 * red + 0.6806995451 * green + 0.1073969566 * blue);
  const double s = std::cbrt(0.0883024619 * red + 0.2817188376 * green + 0.6299787005 * blue);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Rgb8 rgb8_of(const Oklab& color) noexcept {
  const double l = cube(color.lightness + 0.3963377774 * color.a + 0.2158037573 * color.b);
  const double m = cube(color.lightness - 0.1055613458 * color.a - 0.0638541728 * color.b);
  const double s = cube(color.lightness - 0.0894841775 * color.a - 1.2914855480 * color.b);
  const render::Rgb linear{4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                           -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                           -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
  std::array<std::byte, 3> pixel{};
  render::encode_pixel(linear, render::PixelFormat::rgb8, render::Transfer::srgb, pixel.data());
  return {std::to_integer<std::uint8_t>(pixel[0]), std::to_integer<std::uint8_t>(pixel[1]),
          std::to_integer<std::uint8_t>(pixel[2])};
}

double distance_between(const Oklab& a, const Oklab& b) noexcept {
  return std::hypot(a.lightness - b.lightness, a.a - b.a, a.b - b.b);
}

}  // namespace tessera::io
