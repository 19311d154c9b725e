// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/exit_code.h"

namespace tessera::app {

/// Prints what went wrong as one line on stderr and says which exit code it means. Call inside a catch block.
ExitCode report_failure() noexcept;

/// The same for a UsageError, which every rank of a job meets alike: rank 0 prints it, and no rank leaves before it
/// has, for a launcher ends all others when the first rank fails.
ExitCode report_usage_error(int& argc, char**& argv);

}  // namespace tessera::app
