// SPDX-License-Identifier: BSD-3-Clause
#include "io/json_string.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace tessera::io {
namespace {

std::uint8_t byte_at(std::string_view text, std::size_t i) noexcept {
  return static_cast<std::uint8_t>(text[i]);
}

/// What a character begins with: how many bytes follow, and the range of the first of them.
struct Lead {
  std::size_t following;
  std::uint8_t least = 0x80;
  std::uint8_t most = 0xBF;
};

/// following is 0 where no character of several bytes begins like this.
Lead lead_of(std::uint8_t byte) noexcept {
  if (byte < 0xC2 || byte > 0xF4) return {0};
  if (byte < 0xE0) return {1};
  if (byte == 0xE0) return {2, 0xA0};
  if (byte == 0xED) return {2, 0x80, 0x9F};
  if (byte < 0xF0) return {2};
  if (byte == 0xF0) return {3, 0x90};
  if (byte == 0xF4) return {3, 0x80, 0x8F};
  return {3};
}

/// Bytes of the character of several bytes that `text` begins with, 0 where it begins with none.
std::size_t length_of_character(std::string_view text) noexcept {
  const Lead lead = lead_of(byte_at(text, 0));
  if (lead.following == 0 || text.size() <= lead.following) return 0;
  if (byte_at(text, 1) < lead.least || byte_at(text, 1) > lead.most) return 0;
  const auto rest = text.substr(2, lead.following - 1);
  const bool complete = std::all_of(rest.begin(), rest.end(), [](char c) { return (c & 0xC0) == 0x80; });
  return complete ? lead.following + 1 : 0;
}

void append_control(std::string& json, std::uint8_t byte) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  json += "\\u00";
  json += kDigits[byte >> 4];
  json += kDigits[byte & 0xF];
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string json = "\"";
  while (!text.empty()) {
    const std::uint8_t byte = byte_at(text, 0);
    std::size_t taken = 1;
    if (byte == '"' || byte == '\\') {
      json += '\\';
      json += text[0];
    } else if (byte < 0x20 || byte == 0x7F) {
      append_control(json, byte);
    } else if (byte < 0x80) {
      json += text[0];
    } else if (const std::size_t length = length_of_character(text); length > 0) {
      json += text.substr(0, length);
      taken = length;
    } else {
      json += "\xEF\xBF\xBD";
    }
    text.remove_prefix(taken);
  }
  return json += '"';
}

}  // namespace tessera::io
