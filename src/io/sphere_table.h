// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/material_set.h"
#include "io/table_columns.h"
#include "render/scene_data.h"

// Spheres in bulk, a row each.
//
// Text (any ending but .bin): `x y z r [r g b] [material]` per line with blanks, tabs or commas between, `#` to the
// end of the line is a comment. The first line may name the columns (see table_columns.h); without names the number
// of fields tells what they are.
// Binary (.bin): rows of little-endian float64, x y z r unless the columns are named.
//
// A colour is linear and takes the place of the material's.
namespace tessera::io {

struct SphereTableOptions {
  std::vector<PlacedWord> columns;                ///< of every row; empty: the file says it
  std::optional<render::MaterialIndex> material;  ///< of rows that name none; nullopt: the default one
};

struct SphereTable {
  std::vector<render::Sphere> spheres;
  std::vector<std::string> notes;  ///< what was not used, a line each
};

/// Reads a table; materials that its colours ask for join `materials`.
/// throws:  Error(input_missing / io_failure / bad_scene); the last one with line and column, or row and column
SphereTable read_sphere_table(const std::filesystem::path& path, const SphereTableOptions& options,
                              MaterialSet& materials);

}  // namespace tessera::io
