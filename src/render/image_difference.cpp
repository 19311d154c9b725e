// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_difference.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace tessera::render {
namespace {

constexpr double kStepHalf = 1.0 / 510;  // half a step of an 8-bit picture
constexpr double kRelativeFloor = 0.01;  // keeps relMSE finite in the dark, as usual in the field

template <class Channel>
double load(const Image& image, std::size_t channel) noexcept {
  Channel value;
  std::memcpy(&value, image.bytes.data() + channel * sizeof value, sizeof value);
  return value;
}

double distance_between(double a, double b) noexcept {
  const bool comparable = std::isfinite(a) && std::isfinite(b);
  if (comparable) return std::abs(a - b);
  const bool same =
      (std::isnan(a) && std::isnan(b)) || (std::isinf(a) && std::isinf(b) && std::signbit(a) == std::signbit(b));
  return same ? 0 : std::numeric_limits<double>::infinity();
}

}  // namespace

double channel_value(const Image& image, std::size_t channel) noexcept {
  switch (image.format) {
    case PixelFormat::rgb8:
      return load<std::uint8_t>(image, channel) / 255;
    case PixelFormat::rgb16:
      return load<std::uint16_t>(image, channel) / 65535;
    case PixelFormat::rgb32f:
      break;
  }
  return load<float>(image, channel);
}

ImageDifference difference_between(const Image& a, const Image& b) {
  ImageDifference result;
  const std::size_t pixels = std::size_t{a.width} * a.height;
  double square_sum = 0;
  double relative_sum = 0;
  for (std::size_t pixel = 0; pixel != pixels; ++pixel) {
    bool off = false;
    for (std::size_t channel = 3 * pixel; channel != 3 * pixel + 3; ++channel) {
      const double reference = channel_value(b, channel);
      const double error = distance_between(channel_value(a, channel), reference);
      if (error == 0) continue;
      result.max_abs = std::max(result.max_abs, error);
      square_sum += error * error;
      relative_sum += error * error / (reference * reference + kRelativeFloor);
      off = off || error > kStepHalf;
    }
    result.off_pixels += off ? 1 : 0;
  }
  const double channels = 3 * static_cast<double>(pixels);
  result.rmse = std::sqrt(square_sum / channels);
  result.rel_mse = relative_sum / channels;
  result.psnr_db = result.rmse > 0 ? -20 * std::log10(result.rmse) : std::numeric_limits<double>::infinity();
  result.off_share = static_cast<double>(result.off_pixels) / static_cast<double>(pixels);
  return result;
}

}  // namespace tessera::render
