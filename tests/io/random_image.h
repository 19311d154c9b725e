// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>

#include "render/image.h"

namespace tessera::io::test {

/// An image of reproducible noise; float pixels are finite and of all sizes.
inline render::Image random_image(std::uint32_t width, std::uint32_t height, render::PixelFormat format) {
  render::Image image(width, height, format);
  std::mt19937 random(7 * width + height);
  for (std::byte& byte : image.bytes) byte = static_cast<std::byte>(random() & 0xff);
  if (format == render::PixelFormat::rgb32f) {
    for (std::size_t i = 0; i < image.bytes.size(); i += sizeof(float)) {
      const float value = std::ldexp(static_cast<float>(random()) / 4e9f - 0.5f, static_cast<int>(random() % 60) - 30);
      std::memcpy(image.bytes.data() + i, &value, sizeof value);
    }
  }
  return image;
}

}  // namespace tessera::io::test
