// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/place.h"

// What the columns of a sphere table hold.
namespace tessera::io {

enum class Column : std::uint8_t { x, y, z, radius, red, green, blue, material, unused };

inline constexpr std::size_t kNumberColumns = 7;  ///< x ... blue hold numbers
inline constexpr std::array<std::string_view, 9> kColumnNames{"x",     "y",    "z",        "radius",       "red",
                                                              "green", "blue", "material", "unused column"};

constexpr std::size_t position_of(Column column) noexcept {
  return static_cast<std::size_t>(column);
}
constexpr std::string_view name_of(Column column) noexcept {
  return kColumnNames[position_of(column)];
}

struct TableColumns {
  std::vector<Column> columns;      ///< in the order of a row
  std::vector<std::string> unused;  ///< the names of those that we have no use for

  bool has(Column column) const noexcept;
};

/// Understands the names in a heading line or a TOML array: x, y, z, r or radius, red, green, blue and material, in any
/// order and case. The first four are required, the colours come together or not at all. Another name is an unused
/// column, unless it looks mistyped.
/// throws:  Error(bad_scene)
TableColumns name_columns(const std::vector<PlacedWord>& names);

/// What a row of so many fields holds where nobody says it: x y z r [r g b] [material]; empty where that can't be.
/// shapes:  result is empty or has `fields` (4, 5, 7 or 8) columns
const std::vector<Column>& plain_columns(std::size_t fields);

}  // namespace tessera::io
