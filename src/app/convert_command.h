// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/exit_code.h"
#include "app/options.h"

namespace tessera::app {

/// Writes a scene in the format that the output's ending names; a .toml with many spheres gets a table of them beside
/// it. What the format cannot say exactly goes to stderr in notes, after those of the reader.
/// throws:  UsageError, io::Error
ExitCode run_convert(const ConvertOptions& options);

}  // namespace tessera::app
