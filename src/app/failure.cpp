// SPDX-License-Identifier: BSD-3-Clause
#include "app/failure.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <new>

#include "app/interruption.h"
#include "io/error.h"
#include "scheduler/launcher.h"
#include "scheduler/mpi/session.h"

namespace tessera::app {
namespace {

ExitCode code_of(io::ErrorKind kind) noexcept {
  switch (kind) {
    case io::ErrorKind::bad_scene:
      return ExitCode::bad_scene;
    case io::ErrorKind::input_missing:
      return ExitCode::input_missing;
    case io::ErrorKind::cannot_create:
      return ExitCode::cannot_create;
    case io::ErrorKind::io_failure:
      return ExitCode::io_failure;
  }
  return ExitCode::internal;
}

/// One line, whatever a file's name holds, in one write: between two a launcher may put words of its own.
void print(const char* what) noexcept {
  std::array<char, 4096> line;
  const int length = std::snprintf(line.data(), line.size() - 1, "tessera: %s", what);
  char* const end = line.data() + std::min(static_cast<std::size_t>(length), line.size() - 2);
  std::replace_if(
      line.data(), end, [](char c) { return c == '\n' || c == '\r'; }, '?');
  *end = '\n';
  std::fwrite(line.data(), 1, static_cast<std::size_t>(end + 1 - line.data()), stderr);
}

}  // namespace

ExitCode report_failure() noexcept {
  try {
    throw;
  } catch (const io::Error& error) {
    print(error.what());
    return code_of(error.kind());
  } catch (const UsageError& error) {
    print(error.what());
    return ExitCode::usage;
  } catch (const Interrupted& interrupted) {
    print(interrupted.what());
    return interrupted.code();
  } catch (const std::bad_alloc&) {
    print("out of memory");
  } catch (const std::exception& error) {
    print(error.what());
  } catch (...) {
    print("unknown error");
  }
  return ExitCode::internal;
}

ExitCode report_usage_error(int& argc, char**& argv) {
  if (!scheduler::launched_by_mpi()) return report_failure();
  scheduler::mpi::Session session(argc, argv);
  if (session.rank() == scheduler::kMasterRank) report_failure();
  session.barrier();
  return ExitCode::usage;
}

}  // namespace tessera::app
