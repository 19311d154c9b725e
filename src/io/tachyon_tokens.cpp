// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_tokens.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "io/read_file.h"

namespace tessera::io {
namespace {

constexpr bool is_blank(char c) noexcept {
  return c == ' ' || (c >= '\t' && c <= '\r');
}
constexpr char upper(char c) noexcept {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

}  // namespace

bool is_keyword(std::string_view word, std::string_view keyword) noexcept {
  return word.size() == keyword.size() &&
         std::equal(word.begin(), word.end(), keyword.begin(), [](char a, char b) { return upper(a) == upper(b); });
}

TachyonTokens::TachyonTokens(const std::filesystem::path& path) : path_(path), bytes_(read_file(path)) {}

std::string_view TachyonTokens::next() noexcept {
  const std::string_view all = bytes_;
  while (true) {
    while (next_ < all.size() && is_blank(all[next_])) ++next_;
    word_ = next_;
    while (next_ < all.size() && !is_blank(all[next_])) ++next_;
    const std::string_view word = all.substr(word_, next_ - word_);
    if (word != "#") return word;
    next_ = std::min(all.find('\n', next_), all.size());
  }
}

bool TachyonTokens::take(std::string_view keyword) noexcept {
  const Mark word = word_;
  const std::size_t after = next_;
  if (is_keyword(next(), keyword)) return true;
  word_ = word;
  next_ = after;
  return false;
}

void TachyonTokens::expect(std::string_view keyword) {
  const std::string_view found = next();
  if (!is_keyword(found, keyword)) fail_expected(keyword, found);
}

std::string_view TachyonTokens::word(std::string_view what) {
  const std::string_view found = next();
  if (found.empty()) fail_expected(what, found);
  return found;
}

double TachyonTokens::number() {
  const std::string_view found = next();
  std::string_view digits = found;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_out_of_range = error == std::errc::result_out_of_range;
  if ((error != std::errc{} && !is_out_of_range) || end != digits.data() + digits.size()) {
    fail_expected("a number", found);
  }
  if (is_out_of_range) value = std::strtod(std::string(digits).c_str(), nullptr);  // infinite, or tiny and fine
  if (!std::isfinite(value)) fail("number out of range (" + in_quotes(found) + " is not finite)");
  return value;
}

std::int64_t TachyonTokens::integer() {
  const std::string_view found = next();
  std::string_view digits = found;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) fail_expected("a whole number", found);
  return value;
}

render::Vec3 TachyonTokens::vector() {
  const double x = number();
  const double y = number();
  return {x, y, number()};
}

render::Rgb TachyonTokens::color() {
  const double r = number();
  const double g = number();
  return {r, g, number()};
}

Place TachyonTokens::place_of(Mark mark) const {
  const std::string_view before = std::string_view(bytes_).substr(0, mark);
  const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  return {path_.string(), line, mark - (before.rfind('\n') + 1) + 1};  // npos + 1 is 0
}

void TachyonTokens::fail_expected(std::string_view expected, std::string_view found) const {
  fail("expected " + std::string(expected) +
       (found.empty() ? " (the file ends here)" : " (found " + in_quotes(found) + ")"));
}

}  // namespace tessera::io
