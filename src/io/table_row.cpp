// SPDX-License-Identifier: BSD-3-Clause
#include "io/table_row.h"

#include "render/check.h"

namespace tessera::io {

std::optional<RowProblem> RowConverter::convert(const TableRow& row, render::Sphere& sphere) {
  const auto& [x, y, z, radius, red, green, blue] = row.numbers;
  sphere.center = {x, y, z};
  sphere.radius = radius;
  if (const auto problem = problem_with(sphere)) return RowProblem{Column::radius, *problem};

  if (!row.material && !material_) material_ = materials_.default_material();
  sphere.material = row.material ? *row.material : *material_;
  if (!row.has_color) return std::nullopt;

  const std::size_t known = materials_.size();
  sphere.material = materials_.colored(sphere.material, {red, green, blue});
  if (materials_.size() == known) return std::nullopt;
  const auto problem = problem_with(materials_[sphere.material]);
  return problem ? std::optional(RowProblem{Column::red, *problem}) : std::nullopt;
}

}  // namespace tessera::io
