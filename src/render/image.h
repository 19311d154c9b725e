// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

// A picture in memory, in the numbers of the file it is going to or came from.
namespace tessera::render {

/// How a pixel is stored: three channels R, G, B of this type, host byte order.
enum class PixelFormat : std::uint8_t { rgb8, rgb16, rgb32f };

constexpr std::size_t bytes_per_pixel(PixelFormat format) noexcept {
  return format == PixelFormat::rgb8 ? 3 : format == PixelFormat::rgb16 ? 6 : 12;
}

/// A rectangle of pixels; (x, y) is its top left corner, row 0 is on top.
struct Rect {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;

  std::size_t pixels() const noexcept { return std::size_t{width} * height; }
  friend bool operator==(const Rect&, const Rect&) = default;
};

/// shapes:  bytes holds height rows of width pixels, top row first, no padding
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  PixelFormat format = PixelFormat::rgb8;
  std::vector<std::byte> bytes;

  Image() = default;
  Image(std::uint32_t w, std::uint32_t h, PixelFormat f)
      : width(w), height(h), format(f), bytes(std::size_t{w} * h * bytes_per_pixel(f)) {}
};

}  // namespace tessera::render
