// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "render/image.h"

// Pictures of a schedule: the tiles in their places, each in one colour that says something of it. PNG, at the
// picture's resolution; text chunks say how to read the colours.
namespace tessera::io {

/// What a tile cost in seconds a pixel, on a logarithmic scale from the cheapest to the dearest: see scale_color.
/// Text: Title, Unit, Scale, Minimum, Maximum (the numbers alone) and Colors, the two ends of the scale.
/// shapes:  tiles cover `area`; one value of `seconds` per tile
/// throws:  as encode_png
std::string encode_cost_map(const render::Rect& area, std::span<const render::Rect> tiles,
                            std::span<const double> seconds);

/// Which of `rank_count` ranks rendered a tile, each in its own of rank_colors.
/// Text: Title and Colors, a line "rank #rrggbb" for each rank.
/// shapes:  tiles cover `area`; one value of `ranks` per tile, each below rank_count
/// throws:  as encode_png
std::string encode_owner_map(const render::Rect& area, std::span<const render::Rect> tiles,
                             std::span<const std::uint32_t> ranks, std::uint32_t rank_count);

}  // namespace tessera::io
