// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "app/exit_code.h"

// How a person or a system ends the program before it is done: by SIGINT (Ctrl-C) or SIGTERM.
namespace tessera::app {

/// What the first of these signals does; a second one ends the process at once.
enum class OnSignal : std::uint8_t {
  note,      ///< nothing, until the program looks at pending_signal()
  end_soon,  ///< ends the process 0.25 s later. A launcher that ends a job signals all ranks, and kills the rest as
             ///< soon as one has died; so rank 0 has time to put its files in order
};

/// Watches for these signals while it lives. What was ignored when the program started stays ignored, as nohup and
/// shells expect. One at a time.
class SignalWatch {
 public:
  explicit SignalWatch(OnSignal action);
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

 private:
  struct sigaction interrupt_before_ {};
  struct sigaction terminate_before_ {};
};

/// The signal that has come, or 0.
int pending_signal() noexcept;

/// A signal ends the program.
class Interrupted : public std::runtime_error {
 public:
  /// what() is "interrupted (SIGINT) <advice>".
  Interrupted(int signal, const std::string& advice);

  /// 128 + the number of the signal, as a shell would say.
  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

}  // namespace tessera::app
