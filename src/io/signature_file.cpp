// SPDX-License-Identifier: BSD-3-Clause
#include "io/signature_file.h"

#include <bit>
#include <cstring>
#include <type_traits>

#include "io/error.h"
#include "io/netpbm_header.h"
#include "io/read_file.h"

namespace tessera::io {
namespace {

using render::Signature;
static_assert(std::is_trivially_copyable_v<Signature> && std::is_standard_layout_v<Signature>);
static_assert(std::endian::native == std::endian::little, "signatures are written as they lie in memory");

}  // namespace

std::string encode_signatures(const render::SignatureImage& image) {
  std::string bytes = "TS\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n1\n";
  const std::size_t header = bytes.size();
  bytes.resize(header + image.pixels.size() * sizeof(Signature));
  std::memcpy(bytes.data() + header, image.pixels.data(), image.pixels.size() * sizeof(Signature));
  return bytes;
}

render::SignatureImage decode_signatures(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with("TS")) {
    throw Error(ErrorKind::bad_scene, name + ": no signatures (they begin with TS) write them with --signature");
  }
  const NetpbmHeader header = read_netpbm_header(bytes, name);
  if (header.scale != "1") {
    throw Error(ErrorKind::bad_scene,
                name + ": signatures of version \"" + std::string(header.scale) + "\" (this program reads version 1)");
  }
  check_pixel_count(header, header.width * sizeof(Signature), name);
  render::SignatureImage image{header.width, header.height, {}};
  image.pixels.resize(std::size_t{header.width} * header.height);
  std::memcpy(image.pixels.data(), header.pixels.data(), header.pixels.size());
  return image;
}

render::SignatureImage read_signatures(const std::filesystem::path& path) {
  return decode_signatures(read_file(path), path.string());
}

}  // namespace tessera::io
