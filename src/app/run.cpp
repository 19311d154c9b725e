// SPDX-License-Identifier: BSD-3-Clause
#include "app/run.h"

#include <cstdio>
#include <string>

#include "app/compare_command.h"
#include "app/info_command.h"
#include "app/options.h"
#include "app/render_command.h"
#include "scheduler/launcher.h"

namespace tessera::app {
namespace {

/// The command line again, for the statistics.
std::string joined(int argc, char** argv) {
  std::string line = "tessera";
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  return line;
}

}  // namespace

ExitCode run(int argc, char** argv) {
  const Command command = parse_command_line(argc, argv);
  if (const auto* render = std::get_if<RenderOptions>(&command)) {
    return run_render(*render, joined(argc, argv), argc, argv);
  }

  // The other commands are one process's work.
  if (scheduler::launched_rank() != 0) return ExitCode::success;
  if (const auto* compare = std::get_if<CompareOptions>(&command)) return run_compare(*compare);
  if (const auto* info = std::get_if<InfoOptions>(&command)) return run_info(*info);
  std::fputs(std::get<TextRequest>(command).text.c_str(), stdout);
  return ExitCode::success;
}

}  // namespace tessera::app
