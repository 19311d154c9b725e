// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/exit_code.h"
#include "app/options.h"

namespace tessera::app {

/// Prints on stdout how far two pictures are apart; `different` where a channel is off by more than the tolerance.
/// throws:  io::Error
ExitCode run_compare(const CompareOptions& options);

}  // namespace tessera::app
