// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace tessera::app {

/// What the program's end tells a script; 64 and up as in sysexits.h.
enum class ExitCode : int {
  success = 0,
  different = 1,  ///< compare: past the tolerance
  usage = 64,
  bad_scene = 65,
  input_missing = 66,
  internal = 70,
  cannot_create = 73,
  io_failure = 74,
  interrupted = 130,  ///< by SIGINT; a journal keeps what was rendered
  terminated = 143,   ///< by SIGTERM, likewise
};

/// The command line cannot be carried out; what() says why in one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tessera::app
