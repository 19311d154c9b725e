// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

#include "render/color.h"

// Colours as people write them.
namespace tessera::io {

/// The linear colour of "#rrggbb", which is sRGB-encoded; nullopt for any other text.
std::optional<render::Rgb> parse_hex_color(std::string_view text);

}  // namespace tessera::io
