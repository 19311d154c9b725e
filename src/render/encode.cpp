// SPDX-License-Identifier: BSD-3-Clause
#include "render/encode.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "render/power.h"

namespace tessera::render {
namespace {

/// The linear values at which the number of an sRGB channel goes up by one: to n from (n - 1/2) / top on.
template <class Channel>
const auto& srgb_steps() noexcept {
  constexpr std::size_t top = static_cast<Channel>(-1);
  static const auto steps = [] {
    std::array<double, top> values;
    for (std::size_t n = 1; n <= top; ++n) {
      values[n - 1] = linear_from_srgb((static_cast<double>(n) - 0.5) / static_cast<double>(top));
    }
    return values;
  }();
  return steps;
}

/// floor(top x + 0.5) of the encoded value x, top being the largest number of the type.
template <class Channel>
Channel quantized(double linear, Transfer transfer) noexcept {
  const double clamped = std::clamp(linear, 0.0, 1.0);
  if (transfer == Transfer::none) {
    return static_cast<Channel>(std::floor(static_cast<double>(static_cast<Channel>(-1)) * clamped + 0.5));
  }
  const auto& steps = srgb_steps<Channel>();
  return static_cast<Channel>(std::upper_bound(steps.begin(), steps.end(), clamped) - steps.begin());
}

/// The nearest float; beyond them all the largest, for a file's reader may stumble over an infinity.
float as_float(double linear) noexcept {
  return static_cast<float>(std::min(linear, static_cast<double>(std::numeric_limits<float>::max())));
}

template <class Channel>
void store(const std::array<Channel, 3>& channels, std::byte* pixel) noexcept {
  std::memcpy(pixel, channels.data(), sizeof channels);
}

}  // namespace

double srgb_from_linear(double linear) noexcept {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * power(linear, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double encoded) noexcept {
  return encoded <= 0.04045 ? encoded / 12.92 : power((encoded + 0.055) / 1.055, 2.4);
}

void encode_pixel(const Rgb& c, PixelFormat format, Transfer transfer, std::byte* pixel) noexcept {
  const auto all = [&]<class Channel>(Channel) {
    store<Channel>(
        {quantized<Channel>(c.r, transfer), quantized<Channel>(c.g, transfer), quantized<Channel>(c.b, transfer)},
        pixel);
  };
  switch (format) {
    case PixelFormat::rgb8:
      return all(std::uint8_t{});
    case PixelFormat::rgb16:
      return all(std::uint16_t{});
    case PixelFormat::rgb32f:
      return store<float>({as_float(c.r), as_float(c.g), as_float(c.b)}, pixel);
  }
}

}  // namespace tessera::render
