// SPDX-License-Identifier: BSD-3-Clause
#include "io/pfm.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "io/error.h"
#include "io/netpbm_header.h"

namespace tessera::io {
namespace {

constexpr std::size_t kSample = sizeof(float);

// Copies one float, its bytes reversed where the two orders differ.
void copy_sample(void* to, const void* from, std::endian order) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, from, kSample);
  if (order != std::endian::native) bits = __builtin_bswap32(bits);
  std::memcpy(to, &bits, kSample);
}

std::endian byte_order_of(std::string_view scale, const std::string& name) {
  double value = 0;
  const auto [end, error] = std::from_chars(scale.data(), scale.data() + scale.size(), value);
  if (error != std::errc{} || end != scale.data() + scale.size() || !std::isfinite(value) || value == 0) {
    throw Error(ErrorKind::bad_scene, name + ": bad PFM header (the scale must be a number other than 0)");
  }
  return value < 0 ? std::endian::little : std::endian::big;
}

}  // namespace

std::string encode_pfm(const render::Image& image) {
  if (image.format != render::PixelFormat::rgb32f) throw std::invalid_argument("a PFM holds float pixels");
  std::string bytes = "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
  const std::size_t header = bytes.size();
  const std::size_t row = image.width * bytes_per_pixel(image.format);
  bytes.resize(header + row * image.height);
  for (std::size_t y = 0; y < image.height; ++y) {
    const std::byte* from = image.bytes.data() + (image.height - 1 - y) * row;
    char* to = bytes.data() + header + y * row;
    for (std::size_t i = 0; i < row; i += kSample) copy_sample(to + i, from + i, std::endian::little);
  }
  return bytes;
}

render::Image decode_pfm(std::string_view bytes, const std::string& name) {
  const NetpbmHeader header = read_netpbm_header(bytes, name);
  if (header.magic != "PF" && header.magic != "Pf") {
    throw Error(ErrorKind::bad_scene, name + ": not a PFM (it must begin with PF or Pf)");
  }
  const std::endian order = byte_order_of(header.scale, name);
  const std::size_t channels = header.magic == "PF" ? 3 : 1;
  const std::size_t row = header.width * channels * kSample;
  check_pixel_count(header, row, name);

  render::Image image(header.width, header.height, render::PixelFormat::rgb32f);
  std::byte* to = image.bytes.data();
  for (std::size_t y = header.height; y-- > 0;) {
    for (std::size_t sample = 0; sample < std::size_t{3} * header.width; ++sample, to += kSample) {
      copy_sample(to, header.pixels.data() + y * row + sample * channels / 3 * kSample, order);
    }
  }
  return image;
}

}  // namespace tessera::io
