// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/rgb8.h"

// Colours by how they look: in Oklab equal distances are equally different to the eye.
// source: Ottosson, A perceptual color space for image processing (2020)
namespace tessera::io {

/// Lightness from 0, black, to 1, white; a from green to red, b from blue to yellow.
struct Oklab {
  double lightness = 0;
  double a = 0;
  double b = 0;
};

Oklab oklab_of(const Rgb8& color) noexcept;

/// The nearest pixel, channel by channel.
Rgb8 rgb8_of(const Oklab& color) noexcept;

double distance_between(const Oklab& a, const Oklab& b) noexcept;

}  // namespace tessera::io
