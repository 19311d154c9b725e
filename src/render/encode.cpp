// SPDX-License-Identifier: BSD-3-Clause
#include "render/encode.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "render/power.h"

namespace tessera::render {
namespace {

/// How finely SrgbSteps divides the linear values: a cell is 1 / 2^kMantissaBits of the power of two below it.
/// source:  the curve's steps are at least 1 / 84 (8 bits) and 1 / 21,600 (16 bits) of the power of two below them
template <class Channel>
struct SrgbCells;
template <>
struct SrgbCells<std::uint8_t> {
  static constexpr int kLeastExponent = -13;  ///< the first step is above 2^kLeastExponent
  static constexpr int kMantissaBits = 7;
  static constexpr std::size_t kMostSteps = 1;  ///< a cell holds no more; one less than a power of two
};
template <>
struct SrgbCells<std::uint16_t> {
  static constexpr int kLeastExponent = -21;
  static constexpr int kMantissaBits = 10;
  static constexpr std::size_t kMostSteps = 31;
};

/// The steps of an sRGB channel. A value's number is looked up by its leading bits, its cell, and then goes up by the
/// steps in the cell that are not above the value: no branch depends on it.
template <class Channel>
class SrgbSteps : SrgbCells<Channel> {
 public:
  SrgbSteps() noexcept {
    steps_.fill(std::numeric_limits<double>::infinity());
    for (std::size_t n = 1; n <= kTop; ++n) {
      steps_[n - 1] = linear_from_srgb((static_cast<double>(n) - 0.5) / static_cast<double>(kTop));
    }
    for (std::size_t cell = 0; cell != numbers_.size(); ++cell) {
      const double start = std::bit_cast<double>((kFirstCell + cell) << kIgnoredBits);
      numbers_[cell] = static_cast<Channel>(std::upper_bound(steps_.begin(), steps_.end(), start) - steps_.begin());
    }
  }

  /// floor(top x + 0.5) of the encoded value x.
  /// shapes:  linear in [0, 1]
  Channel number_of(double linear) const noexcept {
    const double known = std::max(kLeast, linear);
    std::size_t number = numbers_[(std::bit_cast<std::uint64_t>(known) >> kIgnoredBits) - kFirstCell];
    for (std::size_t half = (SrgbSteps::kMostSteps + 1) / 2; half != 0; half /= 2) {
      number += steps_[number + half - 1] <= linear ? half : 0;
    }
    return static_cast<Channel>(number);
  }

 private:
  static constexpr std::size_t kTop = static_cast<Channel>(-1);
  static constexpr int kIgnoredBits = 52 - SrgbSteps::kMantissaBits;
  static constexpr double kLeast = 1 / static_cast<double>(std::uint64_t{1} << -SrgbSteps::kLeastExponent);
  static constexpr std::uint64_t kFirstCell = std::bit_cast<std::uint64_t>(kLeast) >> kIgnoredBits;
  static constexpr std::uint64_t kLastCell = std::bit_cast<std::uint64_t>(1.0) >> kIgnoredBits;

  /// The linear value from which on the number is n + 1; infinity behind the last.
  std::array<double, kTop + SrgbSteps::kMostSteps> steps_;
  std::array<Channel, kLastCell - kFirstCell + 1> numbers_;  ///< where each cell starts
};

/// floor(top x + 0.5) of the encoded value x, top being the largest number of the type.
template <class Channel>
Channel quantized(double linear, Transfer transfer) noexcept {
  const double clamped = std::clamp(linear, 0.0, 1.0);
  if (transfer == Transfer::none) return static_cast<Channel>(static_cast<Channel>(-1) * clamped + 0.5);
  static const SrgbSteps<Channel> steps;
  return steps.number_of(clamped);
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
