// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/image.h"
#include "render/scene_data.h"

// From linear radiance to the numbers of a picture.
namespace tessera::render {

/// The sRGB curve, piecewise.
/// shapes:  linear in [0, 1]; result in [0, 1]
/// source:  IEC 61966-2-1
double srgb_from_linear(double linear) noexcept;

/// Its inverse.
double linear_from_srgb(double encoded) noexcept;

/// Writes one pixel: clamped, through the transfer curve and rounded half up for rgb8 and rgb16; as it is for rgb32f.
/// shapes:  `pixel` has room for bytes_per_pixel(format)
void encode_pixel(const Rgb& linear, PixelFormat format, Transfer transfer, std::byte* pixel) noexcept;

}  // namespace tessera::render
