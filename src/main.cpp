// SPDX-License-Identifier: BSD-3-Clause
#include "app/failure.h"
#include "app/run.h"
#include "scheduler/launcher.h"

int main(int argc, char** argv) {
  using namespace tessera;
  try {
    return static_cast<int>(app::run(argc, argv));
  } catch (const app::UsageError&) {
    // Every rank sees the same command line: one complains.
    return static_cast<int>(scheduler::launched_rank() == 0 ? app::report_failure() : app::ExitCode::usage);
  } catch (...) {
    return static_cast<int>(app::report_failure());
  }
}
