// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image.h"
#include "render/scene_data.h"

// PNG through libpng: 8 and 16 bit RGB, no date inside, so equal pictures are equal files.
namespace tessera::io {

using PngText = std::vector<std::pair<std::string, std::string>>;  ///< keyword (1-79 Latin-1 characters) and text

struct PngHeader {
  std::uint32_t width;
  std::uint32_t height;
  render::PixelFormat format;
  render::Transfer transfer;
};

/// Makes a PNG while its rows become known. In whichever pieces they come, the file is the same as encode_png's.
class PngEncoder {
 public:
  /// throws:  as encode_png
  PngEncoder(const PngHeader& header, const PngText& text);
  PngEncoder(PngEncoder&&) noexcept;
  ~PngEncoder();

  /// Takes the next rows from the top.
  /// shapes:  whole rows, no more than are missing
  /// throws:  std::invalid_argument, Error(io_failure)
  void add_rows(std::span<const std::byte> pixels);

  /// The bytes of the file.
  /// throws:  std::logic_error where rows are missing, Error(io_failure)
  std::string finish() &&;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The bytes of a PNG file. With Transfer::srgb it carries sRGB and gAMA, with none neither.
/// shapes:  image is rgb8 or rgb16, width and height >= 1
/// throws:  Error(io_failure) with libpng's reason; std::invalid_argument for another pixel format
std::string encode_png(const render::Image& image, render::Transfer transfer, const PngText& text);

/// Any PNG as rgb8 or rgb16: grey and palette expanded, alpha dropped.
/// throws:  Error(bad_scene) that begins with `name`
render::Image decode_png(std::string_view bytes, const std::string& name);

}  // namespace tessera::io
