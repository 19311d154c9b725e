// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "render/image.h"

// Binary PPM ("P6"): the plainest picture file there is, 8 or 16 bits, big-endian.
namespace tessera::io {

/// The bytes of a PPM file.
/// shapes:  image is rgb8 (maxval 255) or rgb16 (65535)
/// throws:  std::invalid_argument for another pixel format
std::string encode_ppm(const render::Image& image);

/// Strict: the file holds one picture of maxval 255 or 65535 and nothing more. The header may have comments.
/// throws:  Error(bad_scene) that begins with `name`
render::Image decode_ppm(std::string_view bytes, const std::string& name);

}  // namespace tessera::io
