// SPDX-License-Identifier: BSD-3-Clause
#include "io/hex_color.h"

#include <charconv>
#include <cstdint>
#include <system_error>

#include "render/encode.h"

namespace tessera::io {

std::optional<render::Rgb> parse_hex_color(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::uint32_t rgb = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), rgb, 16);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;

  const auto channel = [rgb](int shift) { return render::linear_from_srgb(((rgb >> shift) & 0xff) / 255.0); };
  return render::Rgb{channel(16), channel(8), channel(0)};
}

}  // namespace tessera::io
