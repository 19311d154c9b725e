// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_file.h"

#include "io/error.h"
#include "io/lower_case.h"
#include "io/pfm.h"
#include "io/ppm.h"
#include "io/read_file.h"

namespace tessera::io {

std::optional<ImageFormat> image_format_of(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  if (ending == ".png") return ImageFormat::png;
  if (ending == ".ppm") return ImageFormat::ppm;
  if (ending == ".pfm") return ImageFormat::pfm;
  return std::nullopt;
}

render::PixelFormat pixel_format_for(ImageFormat format, BitDepth bits) noexcept {
  if (format == ImageFormat::pfm) return render::PixelFormat::rgb32f;
  return bits == BitDepth::eight ? render::PixelFormat::rgb8 : render::PixelFormat::rgb16;
}

std::string encode_image(ImageFormat format, const render::Image& image, render::Transfer transfer,
                         const PngText& text) {
  switch (format) {
    case ImageFormat::png:
      return encode_png(image, transfer, text);
    case ImageFormat::ppm:
      return encode_ppm(image);
    case ImageFormat::pfm:
      break;
  }
  return encode_pfm(image);
}

render::Image read_image(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  const std::string name = path.string();
  if (bytes.starts_with("\x89PNG")) return decode_png(bytes, name);
  if (bytes.starts_with("P6")) return decode_ppm(bytes, name);
  if (bytes.starts_with("PF") || bytes.starts_with("Pf")) return decode_pfm(bytes, name);
  throw Error(ErrorKind::bad_scene,
              name + ": not a picture we can read (it is no PNG, binary PPM or PFM) convert it to one of them");
}

}  // namespace tessera::io
