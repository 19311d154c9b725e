// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image.h"
#include "render/scene_data.h"

// PNG through libpng: 8 and 16 bit RGB, no date inside, so equal pictures are equal files.
namespace tessera::io {

using PngText = std::vector<std::pair<std::string, std::string>>;  ///< keyword (1-79 Latin-1 characters) and text

/// The bytes of a PNG file. With Transfer::srgb it carries sRGB and gAMA, with none neither.
/// shapes:  image is rgb8 or rgb16, width and height >= 1
/// throws:  Error(io_failure) with libpng's reason; std::invalid_argument for another pixel format
std::string encode_png(const render::Image& image, render::Transfer transfer, const PngText& text);

/// Any PNG as rgb8 or rgb16: grey and palette expanded, alpha dropped.
/// throws:  Error(bad_scene) that begins with `name`
render::Image decode_png(std::string_view bytes, const std::string& name);

}  // namespace tessera::io
