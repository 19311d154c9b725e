// SPDX-License-Identifier: BSD-3-Clause
#include "io/binary_table.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "io/error.h"
#include "io/table_row.h"

namespace tessera::io {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are in the file");

[[noreturn]] void refuse_file(const std::string& file, const std::string& problem) {
  throw Error(ErrorKind::bad_scene, file + ": " + problem);
}

void check_size(std::size_t size, std::size_t columns, const std::string& file) {
  const std::size_t row = columns * sizeof(double);
  if (size == 0) refuse_file(file, "no spheres in the table");
  if (size % row == 0) return;
  refuse_file(file, std::to_string(size) + " bytes are not a whole number of rows (" + std::to_string(columns) +
                        " columns make rows of " + std::to_string(row) + " bytes, " + std::to_string(size % row) +
                        " bytes are left over)");
}

}  // namespace

SphereTable parse_binary_table(std::string_view bytes, const std::string& file, const SphereTableOptions& options,
                               MaterialSet& materials) {
  const TableColumns named =
      options.columns.empty() ? TableColumns{plain_columns(4), {}} : name_columns(options.columns);
  for (std::size_t i = 0; i < named.columns.size(); ++i) {
    if (named.columns[i] == Column::material) {
      refuse(options.columns[i].place, "a binary table holds numbers only (no column \"material\")");
    }
  }
  check_size(bytes.size(), named.columns.size(), file);

  const std::size_t width = named.columns.size();
  SphereTable table;
  table.spheres.resize(bytes.size() / (width * sizeof(double)));
  RowConverter rows(options.material, materials);
  TableRow row;
  row.has_color = named.has(Column::red);
  const char* field = bytes.data();
  for (std::size_t i = 0; i < table.spheres.size(); ++i) {
    const auto refuse_row = [&](const std::string& problem) {
      refuse_file(file, "row " + std::to_string(i + 1) + ": " + problem);
    };
    for (const Column column : named.columns) {
      double number = 0;
      std::memcpy(&number, field, sizeof number);
      field += sizeof number;
      if (column == Column::unused) continue;
      if (!std::isfinite(number)) refuse_row(std::string(name_of(column)) + " must be finite");
      row.numbers[position_of(column)] = number;
    }
    if (const auto problem = rows.convert(row, table.spheres[i])) refuse_row(problem->text);
  }
  return table;
}

}  // namespace tessera::io
