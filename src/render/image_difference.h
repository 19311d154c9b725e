// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "render/image.h"

namespace tessera::render {

/// How far two pictures are apart, over all channels, in the pictures' own numbers: 0 to 1 for 8 and 16 bit, linear
/// for float.
struct ImageDifference {
  double max_abs = 0;
  double rmse = 0;
  double rel_mse = 0;    ///< mean of (a - b)^2 / (b^2 + 0.01), b being the second picture
  double psnr_db = 0;    ///< -20 log10(rmse); infinity for equal pictures
  double off_share = 0;  ///< share of the pixels with a channel off by more than 1/510
  std::size_t off_pixels = 0;
};

/// The value of a channel of a picture, whatever its format.
/// shapes:  channel = 3 (y width + x) + c
double channel_value(const Image& image, std::size_t channel) noexcept;

/// A channel that is NaN or infinite in one of them alone is infinitely far off.
/// requires: equal sizes; formats may differ
ImageDifference difference_between(const Image& a, const Image& b);

}  // namespace tessera::render
