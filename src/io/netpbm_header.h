// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// The text in front of the pixels, alike in PPM and PFM: magic, width, height and one number more.
namespace tessera::io {

struct NetpbmHeader {
  std::string_view magic;  ///< two letters
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string_view scale;   ///< PPM: the largest value; PFM: the sign is the byte order
  std::string_view pixels;  ///< all that follows the header
};

/// Splits a file into header and pixels; `#` begins a comment. Width and height are at least 1.
/// throws:  Error(bad_scene) that begins with `name`
NetpbmHeader read_netpbm_header(std::string_view bytes, const std::string& name);

/// throws:  Error(bad_scene) unless `header` is followed by exactly height rows of `bytes_per_row`
void check_pixel_count(const NetpbmHeader& header, std::size_t bytes_per_row, const std::string& name);

}  // namespace tessera::io
