// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace tessera::io {

/// A pixel of 8 bits a channel, sRGB-encoded.
using Rgb8 = std::array<std::uint8_t, 3>;

}  // namespace tessera::io
