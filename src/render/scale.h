// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/scene_data.h"

namespace tessera::render {

/// Largest ratio of a length in a scene (a coordinate, a radius) to its smallest radius other than 0 or cell of a
/// board: at unit scale, the square of that radius still has all its digits.
inline constexpr double kLargestSpan = 1e140;

/// The same scene in units in which its largest length is from 1/2 to 1, and with directions whose largest component
/// is. Powers of two round nothing, so the picture keeps every bit; what changes is that no product of a few lengths
/// can overflow or vanish. Every scene is brought to this scale before it is traced.
SceneData unit_scaled(SceneData scene);

/// The largest absolute coordinate or length of a scene; 0 for one that has none.
double largest_length_of(const SceneData& scene) noexcept;

}  // namespace tessera::render
