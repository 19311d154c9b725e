// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/png.h"
#include "render/image.h"
#include "render/scene_data.h"

// The picture files we write and read, told apart by their ending.
namespace tessera::io {

enum class ImageFormat : std::uint8_t { png, ppm, pfm };
enum class BitDepth : std::uint8_t { eight = 8, sixteen = 16 };

inline constexpr std::string_view kImageEndings = ".png, .ppm or .pfm";  ///< for messages

/// The format by the ending of the name, in any case, or nullopt for another ending.
std::optional<ImageFormat> image_format_of(const std::filesystem::path& path);

/// What the renderer must deliver for a file: PFM holds floats whatever the bit depth.
render::PixelFormat pixel_format_for(ImageFormat format, BitDepth bits) noexcept;

/// The bytes of the file. Transfer and text go into PNG; the others have no place for them.
/// shapes:  image has the pixel format that pixel_format_for() gives
/// throws:  Error(io_failure); std::invalid_argument for another pixel format
std::string encode_image(ImageFormat format, const render::Image& image, render::Transfer transfer,
                         const PngText& text);

/// Reads a PNG, PPM or PFM, recognised by its first bytes.
/// throws:  Error(input_missing / io_failure / bad_scene) with the name of the file
render::Image read_image(const std::filesystem::path& path);

}  // namespace tessera::io
