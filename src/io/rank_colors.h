// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "io/rgb8.h"

namespace tessera::io {

/// A colour for each of `count` ranks, the same for every count: each rank's is, of 631, the one that looks least like
/// those of the ranks before it. Beyond that many they repeat.
std::vector<Rgb8> rank_colors(std::uint32_t count);

}  // namespace tessera::io
