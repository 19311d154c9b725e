// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "io/material_set.h"
#include "io/table_columns.h"
#include "render/scene_data.h"

// From the fields of a table's row to a sphere, the same for text and binary tables.
namespace tessera::io {

struct TableRow {
  std::array<double, kNumberColumns> numbers{};   ///< at position_of(column), all finite
  std::optional<render::MaterialIndex> material;  ///< where the row names one
  bool has_color = false;
};

struct RowProblem {
  Column column;
  std::string text;
};

/// Makes spheres of rows, and materials of their colours.
class RowConverter {
 public:
  RowConverter(std::optional<render::MaterialIndex> material, MaterialSet& materials)
      : material_(material), materials_(materials) {}

  /// Fills in `sphere`. Returns what is wrong with the row, if anything is.
  std::optional<RowProblem> convert(const TableRow& row, render::Sphere& sphere);

 private:
  std::optional<render::MaterialIndex> material_;  // of rows that name none
  MaterialSet& materials_;
};

}  // namespace tessera::io
