// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/exit_code.h"

namespace tessera::app {

/// Prints what went wrong as one line on stderr and says which exit code it means. Call inside a catch block.
ExitCode report_failure() noexcept;

}  // namespace tessera::app
