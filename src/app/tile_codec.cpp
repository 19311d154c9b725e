// SPDX-License-Identifier: BSD-3-Clause
#include "app/tile_codec.h"

#include <lz4.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace tessera::app {
namespace {

/// How colours travel: the lowest bits of the first byte.
enum class Form : std::uint8_t { raw, one_color, packed };
constexpr std::uint8_t kFormBits = 3;
constexpr std::uint8_t kHasShadowRays = 4;
constexpr std::uint8_t kHasMirrorRays = 8;
constexpr std::uint8_t kAllBits = kFormBits | kHasShadowRays | kHasMirrorRays;

constexpr unsigned kBitsPerByte = 7;
constexpr std::size_t kLongestNumber = 10;  // of 64 bits, 7 a byte
constexpr std::size_t kLongestHeader = 1 + 3 * kLongestNumber;

/// What goes in front of the pixels, as it grows.
class Header {
 public:
  void push(std::uint8_t byte) noexcept { bytes_[size_++] = std::byte{byte}; }
  void push_number(std::uint64_t number) noexcept {
    for (; number >> kBitsPerByte != 0; number >>= kBitsPerByte) push(static_cast<std::uint8_t>(number | 0x80));
    push(static_cast<std::uint8_t>(number));
  }
  std::span<const std::byte> bytes() const noexcept { return std::span(bytes_).first(size_); }

 private:
  std::array<std::byte, kLongestHeader> bytes_{};
  std::size_t size_ = 0;
};

/// What is left of a delivery while it is read.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) noexcept : left_(bytes) {}

  std::span<const std::byte> take(std::size_t size, const char* if_short) {
    if (size > left_.size()) throw std::runtime_error(if_short);
    const auto taken = left_.first(size);
    left_ = left_.subspan(size);
    return taken;
  }
  std::uint8_t take_byte(const char* if_short) { return std::to_integer<std::uint8_t>(take(1, if_short).front()); }
  std::uint64_t take_number() {
    std::uint64_t number = 0;
    for (unsigned shift = 0; shift < 64; shift += kBitsPerByte) {
      const std::uint64_t byte = take_byte("a number is cut off");
      const std::uint64_t bits = byte & 0x7F;
      if (bits << shift >> shift != bits) break;
      number |= bits << shift;
      if (byte == bits) return number;
    }
    throw std::runtime_error("a number is too large");
  }
  bool is_at_end() const noexcept { return left_.empty(); }

 private:
  std::span<const std::byte> left_;
};

/// Every pixel is like the one before it. Ends at the first that is not.
bool has_one_color(std::span<const std::byte> colors, std::size_t pixel_size) {
  return std::memcmp(colors.data(), colors.data() + pixel_size, colors.size() - pixel_size) == 0;
}

/// The colours as an LZ4 block, or empty where that is not shorter.
std::vector<char> packed(std::span<const std::byte> colors) {
  if (colors.size() > LZ4_MAX_INPUT_SIZE) return {};
  std::vector<char> block(colors.size() - 1);
  const int size = LZ4_compress_default(reinterpret_cast<const char*>(colors.data()), block.data(),
                                        static_cast<int>(colors.size()), static_cast<int>(block.size()));
  block.resize(static_cast<std::size_t>(size));
  return block;
}

}  // namespace

TileCodec::TileCodec(render::PixelFormat format, Layers layers, Packing packing)
    : format_(format), layers_(layers), packing_(packing) {}

scheduler::Bytes TileCodec::encode(const render::RayCounts& rays, const render::TilePixels& pixels) const {
  // Choose the shortest form of the colours.
  const std::size_t pixel_size = bytes_per_pixel(format_);
  std::span<const std::byte> colors = pixels.colors;
  Form form = Form::raw;
  std::vector<char> block;
  if (has_one_color(colors, pixel_size)) {
    form = Form::one_color;
    colors = colors.first(pixel_size);
  } else if (packing_ == Packing::where_shorter) {
    block = packed(colors);
    if (!block.empty()) {
      form = Form::packed;
      colors = std::as_bytes(std::span(block));
    }
  }

  Header header;
  header.push(static_cast<std::uint8_t>(static_cast<std::uint8_t>(form) | (rays.shadow > 0 ? kHasShadowRays : 0) |
                                        (rays.mirror > 0 ? kHasMirrorRays : 0)));
  if (rays.shadow > 0) header.push_number(rays.shadow);
  if (rays.mirror > 0) header.push_number(rays.mirror);
  if (form == Form::packed) header.push_number(colors.size());

  const std::array parts{header.bytes(), colors, std::as_bytes(std::span<const render::Signature>(pixels.signatures)),
                         std::as_bytes(std::span<const float>(pixels.errors))};
  scheduler::Bytes delivered;
  std::size_t size = 0;
  for (const auto part : parts) size += part.size();
  delivered.reserve(size);
  for (const auto part : parts) delivered.insert(delivered.end(), part.begin(), part.end());
  return delivered;
}

DeliveredTile TileCodec::decode(std::span<const std::byte> delivered, std::size_t pixels) {
  Reader reader(delivered);
  DeliveredTile tile;
  const std::uint8_t first = reader.take_byte("it is empty");
  const auto form = static_cast<Form>(first & kFormBits);
  if ((first & ~kAllBits) != 0 || form > Form::packed) throw std::runtime_error("its colours travel in an unknown way");
  if ((first & kHasShadowRays) != 0) tile.shadow_rays = reader.take_number();
  if ((first & kHasMirrorRays) != 0) tile.mirror_rays = reader.take_number();

  constexpr const char* kCutOff = "its pixels are cut off";
  const std::size_t pixel_size = bytes_per_pixel(format_);
  const std::size_t raw_size = pixels * pixel_size;
  tile.has_one_color = form == Form::one_color;
  if (form == Form::packed) {
    const std::uint64_t size = reader.take_number();
    // No packed colours are as long as they are raw, so int holds both.
    if (size >= raw_size || raw_size > LZ4_MAX_INPUT_SIZE) throw std::runtime_error("its packed colours are too long");
    const auto block = reader.take(size, kCutOff);
    unpacked_.resize(raw_size);
    const int unpacked_size =
        LZ4_decompress_safe(reinterpret_cast<const char*>(block.data()), reinterpret_cast<char*>(unpacked_.data()),
                            static_cast<int>(size), static_cast<int>(raw_size));
    if (unpacked_size < 0 || static_cast<std::size_t>(unpacked_size) != raw_size) {
      throw std::runtime_error("its packed colours are damaged");
    }
    tile.colors = unpacked_;
  } else {
    tile.colors = reader.take(tile.has_one_color ? pixel_size : raw_size, kCutOff);
  }
  if (layers_.signatures) tile.signatures = reader.take(pixels * sizeof(render::Signature), kCutOff);
  if (layers_.errors) tile.errors = reader.take(pixels * sizeof(float), kCutOff);
  if (!reader.is_at_end()) throw std::runtime_error("there is more than its pixels");
  return tile;
}

}  // namespace tessera::app
