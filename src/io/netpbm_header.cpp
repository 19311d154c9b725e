// SPDX-License-Identifier: BSD-3-Clause
#include "io/netpbm_header.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "io/error.h"

namespace tessera::io {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

// Cuts the next word off the front of `rest`, and the comments before it.
std::string_view take_word(std::string_view& rest) {
  while (true) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    if (rest.empty() || rest.front() != '#') break;
    rest.remove_prefix(std::min(rest.find('\n'), rest.size()));
  }
  const std::string_view word = rest.substr(0, rest.find_first_of(kBlanks));
  rest.remove_prefix(word.size());
  return word;
}

std::uint32_t size_from(std::string_view word, const char* what, const std::string& name) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || value == 0 || value > 0x7fffffff) {
    throw Error(ErrorKind::bad_scene, name + ": bad picture header (no valid " + what + ")");
  }
  return value;
}

}  // namespace

NetpbmHeader read_netpbm_header(std::string_view bytes, const std::string& name) {
  NetpbmHeader header;
  header.magic = bytes.substr(0, 2);
  std::string_view rest = bytes.substr(header.magic.size());
  header.width = size_from(take_word(rest), "width", name);
  header.height = size_from(take_word(rest), "height", name);
  header.scale = take_word(rest);
  // Exactly one blank ends the header: the next byte is a pixel's, whatever it looks like
  if (header.scale.empty() || rest.empty()) {
    throw Error(ErrorKind::bad_scene, name + ": bad picture header (the file ends inside it)");
  }
  header.pixels = rest.substr(1);
  return header;
}

void check_pixel_count(const NetpbmHeader& header, std::size_t bytes_per_row, const std::string& name) {
  // Divided, not multiplied: the product of two sizes from a junk header may not fit
  const std::size_t found = header.pixels.size();
  if (found % bytes_per_row == 0 && found / bytes_per_row == header.height) return;
  throw Error(ErrorKind::bad_scene, name + ": the file's length does not fit its header (" +
                                        std::to_string(header.width) + " x " + std::to_string(header.height) +
                                        " pixels announced, " + std::to_string(found) + " bytes found)");
}

}  // namespace tessera::io
