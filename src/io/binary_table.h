// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "io/sphere_table.h"

// Sphere tables in float64 rows, see sphere_table.h.
namespace tessera::io {

/// Reads the bytes of a file; `file` is its name for messages.
/// throws:  Error(bad_scene)
SphereTable parse_binary_table(std::string_view bytes, const std::string& file, const SphereTableOptions& options,
                               MaterialSet& materials);

}  // namespace tessera::io
