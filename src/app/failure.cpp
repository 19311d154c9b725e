// SPDX-License-Identifier: BSD-3-Clause
#include "app/failure.h"

#include <cstdio>
#include <exception>
#include <new>

#include "io/error.h"

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

void print(const char* what) noexcept {
  std::fprintf(stderr, "tessera: %s\n", what);
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
  } catch (const std::bad_alloc&) {
    print("out of memory");
  } catch (const std::exception& error) {
    print(error.what());
  } catch (...) {
    print("unknown error");
  }
  return ExitCode::internal;
}

}  // namespace tessera::app
