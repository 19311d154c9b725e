// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "render/image.h"

// PFM: linear float32 pixels as they are, unclamped; little-endian, the bottom row first.
namespace tessera::io {

/// The bytes of a PFM file ("PF", scale -1).
/// shapes:  image is rgb32f
/// throws:  std::invalid_argument for another pixel format
std::string encode_pfm(const render::Image& image);

/// A grey PFM ("Pf") of one value a pixel.
/// shapes:  pixels holds height rows of width, top row first
std::string encode_pfm(std::uint32_t width, std::uint32_t height, std::span<const float> pixels);

/// Strict about its length. Reads both byte orders, and grey ("Pf") as three equal channels; of the scale only the
/// sign has a meaning.
/// throws:  Error(bad_scene) that begins with `name`
render::Image decode_pfm(std::string_view bytes, const std::string& name);

}  // namespace tessera::io
