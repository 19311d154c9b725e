// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "app/options.h"
#include "render/image.h"

// How large tiles should be while nobody knows what they cost.
namespace tessera::app {

/// The tile size for `--tile-size auto`.
///
/// Of n tiles that a rank gets, the last is a dear one: waiting for it takes some h/n of the time, where a dear tile
/// costs h times the mean. Rank 0 hands out n P tiles in o each, while ranks render for W/P: that takes n/x of the
/// time, where x = W / (P^2 o). The sum is least at n = sqrt(h x), and then a tile has A / (P n) = sqrt(A o / (h c s))
/// pixels, A being the area, s the samples and c the time of a sample: P cancels out. h = 6 and c = 0.3 us, about
/// what a pixel of our cheaper scenes takes; being wrong four times over makes tiles twice too large or too small. The
/// number of pixels is rounded to a power of two: a square, or two of them side by side, of 64 to 16384 pixels.
/// requires: area and samples are not 0; a pixel takes as long as so many samples of the fast tracer
Size tile_size_without_costs(const render::Rect& area, double samples) noexcept;

/// Whether tiles of that size are not worth handing out one by one: where ranks would get fewer than two each, or x <
/// 6, so that handing out may take longer than the work itself. One band a rank is as well balanced then, and costs a
/// message a rank.
bool bands_will_do(const render::Rect& area, double samples, std::uint32_t ranks) noexcept;

}  // namespace tessera::app
