// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "io/sphere_table.h"

// Sphere tables in text, see sphere_table.h.
namespace tessera::io {

/// Reads the text of a file; `file` is its name for messages.
/// throws:  Error(bad_scene)
SphereTable parse_text_table(std::string_view text, const std::string& file, const SphereTableOptions& options,
                             MaterialSet& materials);

}  // namespace tessera::io
