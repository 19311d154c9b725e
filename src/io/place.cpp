// SPDX-License-Identifier: BSD-3-Clause
#include "io/place.h"

#include <algorithm>

#include "io/error.h"

namespace tessera::io {
namespace {

std::string without_control_characters(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, '?');
  return line;
}

}  // namespace

std::string text_of(const Place& place) {
  return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": ";
}

void refuse(const Place& place, const std::string& problem) {
  throw Error(ErrorKind::bad_scene, text_of(place) + without_control_characters(problem));
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  const std::string text = without_control_characters(word.substr(0, kLongest));
  return '"' + text + (word.size() > kLongest ? "...\"" : "\"");
}

}  // namespace tessera::io
