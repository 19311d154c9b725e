// SPDX-License-Identifier: BSD-3-Clause
#include "render/encode.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace tessera::render {
namespace {

/// floor(top x + 0.5), top being the largest number of the type.
template <class Channel>
Channel quantized(double linear, Transfer transfer) noexcept {
  const double clamped = std::clamp(linear, 0.0, 1.0);
  const double encoded = transfer == Transfer::srgb ? srgb_from_linear(clamped) : clamped;
  return static_cast<Channel>(std::floor(static_cast<double>(static_cast<Channel>(-1)) * encoded + 0.5));
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
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double encoded) noexcept {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
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
