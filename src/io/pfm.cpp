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

std::string encode(const char* magic, std::uint32_t width, std::uint32_t height, std::span<const std::byte> pixels) {
  std::string bytes = std::string(magic).append("\n").append(std::to_string(width)).append(" ");
  bytes.append(std::to_string(height)).append("\n-1.0\n");
  const std::size_t header = bytes.size();
  const std::size_t row = pixels.size() / height;
  bytes.resize(header + pixels.size());
  for (std::size_t y = 0; y < height; ++y) {
    const std::byte* from = pixels.data() + (height - 1 - y) * row;
    char* to = bytes.data() + header + y * row;
    for (std::size_t i = 0; i < row; i += kSample) copy_sample(to + i, from + i, std::endian::little);
  }
  return bytes;
}

}  // namespace

std::string encode_pfm(const render::Image& image) {
  if (image.format != render::PixelFormat::rgb32f) throw std::invalid_argument("a PFM holds float pixels");
  return encode("PF", image.width, image.height, image.bytes);
}

std::string encode_pfm(std::uint32_t width, std::uint32_t height, std::span<const float> pixels) {
  return encode("Pf", width, height, std::as_bytes(pixels));
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
