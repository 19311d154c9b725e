// SPDX-License-Identifier: BSD-3-Clause
#include "app/run.h"

#include <cstdio>
#include <string>

#include "app/compare_command.h"
#include "app/convert_command.h"
#include "app/info_command.h"
#include "app/options.h"
#include "app/render_command.h"
#include "io/error.h"
#include "scheduler/launcher.h"

namespace tessera::app {
namespace {

/// The command line again, for the statistics.
std::string joined(int argc, char** argv) {
  std::string line = "tessera";
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  return line;
}

/// Whatever goes to stdout must arrive there.
void flush_stdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw io::Error(io::ErrorKind::io_failure, "standard output: cannot write");
  }
}

}  // namespace

ExitCode run(int argc, char** argv) {
  const Command command = parse_command_line(argc, argv);
  if (const auto* render = std::get_if<RenderOptions>(&command)) {
    return run_render(*render, joined(argc, argv), argc, argv);
  }

  // The other commands are one process's work.
  if (scheduler::launched_rank() != 0) return ExitCode::success;
  ExitCode code = ExitCode::success;
  if (const auto* compare = std::get_if<CompareOptions>(&command)) code = run_compare(*compare);
  if (const auto* info = std::get_if<InfoOptions>(&command)) code = run_info(*info);
  if (const auto* convert = std::get_if<ConvertOptions>(&command)) code = run_convert(*convert);
  if (const auto* request = std::get_if<TextRequest>(&command)) std::fputs(request->text.c_str(), stdout);
  flush_stdout();
  return code;
}

}  // namespace tessera::app
