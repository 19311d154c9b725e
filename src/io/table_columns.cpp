// SPDX-License-Identifier: BSD-3-Clause
#include "io/table_columns.h"

#include <algorithm>
#include <optional>

#include "io/lower_case.h"
#include "io/suggest.h"

namespace tessera::io {
namespace {

std::optional<Column> column_named(const std::string& text) {
  const std::string name = lower_case(text);
  if (name == "r") return Column::radius;
  for (std::size_t i = 0; i < position_of(Column::unused); ++i) {
    if (name == kColumnNames[i]) return static_cast<Column>(i);
  }
  return std::nullopt;
}

void require(const TableColumns& table, Column column, const Place& place) {
  if (!table.has(column)) {
    refuse(place, "no column " + in_quotes(name_of(column)) + " (columns are named, so x, y, z and radius must be)");
  }
}

}  // namespace

bool TableColumns::has(Column column) const noexcept {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

TableColumns name_columns(const std::vector<PlacedWord>& names) {
  TableColumns table;
  for (const PlacedWord& name : names) {
    const auto column = column_named(name.text);
    if (column && table.has(*column)) refuse(name.place, "column " + in_quotes(name_of(*column)) + " is there twice");
    if (!column) table.unused.push_back(name.text);
    table.columns.push_back(column.value_or(Column::unused));
  }

  // A name near one that is missing was meant to be it
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < position_of(Column::unused); ++i) {
    if (!table.has(static_cast<Column>(i))) missing.emplace_back(kColumnNames[i]);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string hint = table.columns[i] == Column::unused ? did_you_mean(names[i].text, missing) : "";
    if (!hint.empty()) refuse(names[i].place, "unknown column " + in_quotes(names[i].text) + hint);
  }

  const Place& place = names.front().place;
  for (const Column column : {Column::x, Column::y, Column::z, Column::radius}) require(table, column, place);
  const auto colors = std::count_if(table.columns.begin(), table.columns.end(),
                                    [](Column c) { return Column::red <= c && c <= Column::blue; });
  if (colors != 0 && colors != 3) refuse(place, "a colour needs all of the columns red, green and blue");
  return table;
}

const std::vector<Column>& plain_columns(std::size_t fields) {
  using enum Column;
  static const std::vector<Column> kNone;
  static const std::vector<Column> kSphere{x, y, z, radius};
  static const std::vector<Column> kSphereMaterial{x, y, z, radius, material};
  static const std::vector<Column> kSphereColor{x, y, z, radius, red, green, blue};
  static const std::vector<Column> kSphereColorMaterial{x, y, z, radius, red, green, blue, material};
  switch (fields) {
    case 4:
      return kSphere;
    case 5:
      return kSphereMaterial;
    case 7:
      return kSphereColor;
    case 8:
      return kSphereColorMaterial;
    default:
      return kNone;
  }
}

}  // namespace tessera::io
