// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "app/exit_code.h"
#include "app/options.h"

namespace tessera::app {

/// Renders a scene with all ranks that a launcher started, or with this process alone.
/// throws:  UsageError, io::Error and others; under a launcher only what is wrong before MPI begins, for from there on
///          every rank returns the job's exit code or the whole job is ended
ExitCode run_render(const RenderOptions& options, const std::string& command_line, int& argc, char**& argv);

}  // namespace tessera::app
