// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "io/scene_reader.h"

// Our own scene files (.toml): [image], [camera], [environment], [[light]], [material.NAME], [[sphere]], [[plane]],
// [[spheres]] (a table of spheres in a file beside it) and [generate]. Colours "#rrggbb" are sRGB-encoded, [r, g, b]
// are linear.
namespace tessera::io {

/// Spheres keep the order of the file: those of [[sphere]] first, then the tables, then the generated ones.
/// throws:  Error(input_missing / io_failure / bad_scene) "file:line:column: problem (why) suggestion"
ReadScene read_toml_scene(const std::filesystem::path& path);

}  // namespace tessera::io
