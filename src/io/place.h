// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Where in a text file something stands, for messages.
namespace tessera::io {

/// Line and column count from 1.
struct Place {
  std::string file;
  std::size_t line = 1;
  std::size_t column = 1;
};

/// A word of a file and where it begins.
struct PlacedWord {
  std::string text;
  Place place;
};

/// "file:line:column: "
std::string text_of(const Place& place);

/// throws:  Error(bad_scene, "file:line:column: problem"), always; control characters in `problem` become '?'
[[noreturn]] void refuse(const Place& place, const std::string& problem);

/// A word of a file as a message shows it: in double quotes, on one line, shortened where it is long.
std::string in_quotes(std::string_view word);

}  // namespace tessera::io
