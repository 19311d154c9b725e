// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/exit_code.h"
#include "app/options.h"

namespace tessera::app {

/// Prints on stdout what a scene holds: counts, bounds, memory, and what a render need not do for it.
/// throws:  io::Error
ExitCode run_info(const InfoOptions& options);

}  // namespace tessera::app
