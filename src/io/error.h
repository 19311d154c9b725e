// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

// What can be wrong with files, in one type that knows the kind of trouble; main turns the kind into an exit code.
namespace tessera::io {

enum class ErrorKind {
  bad_scene,      ///< the input can be read but not understood
  input_missing,  ///< the input cannot be opened
  cannot_create,  ///< the output cannot be created
  io_failure,     ///< reading or writing failed on the way
};

/// what() is one line for a person: "file:line:column: problem (why) suggestion".
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace tessera::io
