// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/exit_code.h"

namespace tessera::app {

/// Carries out the command line, on every rank alike.
/// throws:  UsageError, io::Error, and whatever shows a defect of ours
ExitCode run(int argc, char** argv);

}  // namespace tessera::app
