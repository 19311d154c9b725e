// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "render/signature_image.h"

// What the pixels of a render decided, as a file for `tessera compare`. A header as PPM has it, with magic TS and the
// version in place of the largest value, then 24 bytes a pixel, top row first, little-endian: two hashes of 64 bits
// (surfaces, lights), the number of hits and the first surface in 32 bits each.
namespace tessera::io {

std::string encode_signatures(const render::SignatureImage& image);

/// throws:  Error(bad_scene) that begins with `name`
render::SignatureImage decode_signatures(std::string_view bytes, const std::string& name);

/// throws:  Error(input_missing / io_failure / bad_scene) with the name of the file
render::SignatureImage read_signatures(const std::filesystem::path& path);

}  // namespace tessera::io
