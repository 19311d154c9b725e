// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/rgb8.h"

namespace tessera::io {

/// The colour of a value on a scale from dark blue through purple, red and orange to pale yellow. Equal steps of the
/// value are equal steps to the eye, and lightness grows all the way, so the scale reads in grey as well.
/// shapes:  value in [0, 1]; what is outside counts as the nearer end
Rgb8 scale_color(double value) noexcept;

}  // namespace tessera::io
