// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_builder.h"

#include <array>
#include <charconv>

namespace tessera::io {

TextBuilder& TextBuilder::operator<<(double value) {
  std::array<char, 32> digits;
  const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  const std::string_view number(digits.data(), static_cast<std::size_t>(end - digits.data()));
  text_ += number;
  // In TOML a number without these is an integer, and may be out of its range.
  if (number.find_first_of(".e") == std::string_view::npos) text_ += ".0";
  return *this;
}

TextBuilder& TextBuilder::operator<<(std::uint64_t value) {
  text_ += std::to_string(value);
  return *this;
}

TextBuilder& TextBuilder::triple(double a, double b, double c) {
  return *this << style_.open << a << style_.separator << b << style_.separator << c << style_.close;
}

}  // namespace tessera::io
