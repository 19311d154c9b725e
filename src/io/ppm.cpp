// SPDX-License-Identifier: BSD-3-Clause
#include "io/ppm.h"

#include <bit>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "io/error.h"
#include "io/netpbm_header.h"

namespace tessera::io {
namespace {

// Between host order and the file's big-endian; each way is the other's inverse.
void swap_16_bit_samples(char* bytes, std::size_t size) {
  if constexpr (std::endian::native == std::endian::big) return;
  for (std::size_t i = 0; i + 1 < size; i += 2) std::swap(bytes[i], bytes[i + 1]);
}

}  // namespace

std::string encode_ppm(const render::Image& image) {
  if (image.format == render::PixelFormat::rgb32f) throw std::invalid_argument("a PPM cannot hold float pixels");
  const bool is_deep = image.format == render::PixelFormat::rgb16;
  std::string bytes = "P6\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n" +
                      (is_deep ? "65535\n" : "255\n");
  const std::size_t header = bytes.size();
  bytes.append(reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size());
  if (is_deep) swap_16_bit_samples(bytes.data() + header, bytes.size() - header);
  return bytes;
}

render::Image decode_ppm(std::string_view bytes, const std::string& name) {
  const NetpbmHeader header = read_netpbm_header(bytes, name);
  if (header.magic != "P6") throw Error(ErrorKind::bad_scene, name + ": not a binary PPM (it must begin with P6)");
  if (header.scale != "255" && header.scale != "65535") {
    throw Error(ErrorKind::bad_scene, name + ": cannot read this PPM (its largest value must be 255 or 65535)");
  }
  const auto format = header.scale == "255" ? render::PixelFormat::rgb8 : render::PixelFormat::rgb16;
  check_pixel_count(header, header.width * bytes_per_pixel(format), name);

  render::Image image(header.width, header.height, format);
  std::memcpy(image.bytes.data(), header.pixels.data(), image.bytes.size());
  if (format == render::PixelFormat::rgb16) {
    swap_16_bit_samples(reinterpret_cast<char*>(image.bytes.data()), image.bytes.size());
  }
  return image;
}

}  // namespace tessera::io
