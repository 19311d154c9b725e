// SPDX-License-Identifier: BSD-3-Clause
#include "app/interruption.h"

#include <sys/time.h>
#include <unistd.h>

namespace tessera::app {
namespace {

constexpr int kShellOffset = 128;
constexpr ::suseconds_t kGraceMicroseconds = 250'000;

volatile std::sig_atomic_t pending = 0;

// In handlers: only what POSIX allows there, and setitimer, which is a mere system call.

void note(int signal) {
  pending = signal;
}

void end_now(int) {
  ::_exit(kShellOffset + pending);
}

void end_soon(int signal) {
  pending = signal;
  const ::itimerval once{.it_interval = {}, .it_value = {.tv_sec = 0, .tv_usec = kGraceMicroseconds}};
  ::setitimer(ITIMER_REAL, &once, nullptr);
}

void on(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  ::sigemptyset(&action.sa_mask);
  ::sigaction(signal, &action, nullptr);
}

/// Returns what was done about the signal before.
struct sigaction watch(int signal, void (*handler)(int)) {
  struct sigaction before {};
  ::sigaction(signal, nullptr, &before);
  if (before.sa_handler != SIG_IGN) on(signal, handler);
  return before;
}

}  // namespace

SignalWatch::SignalWatch(OnSignal action) {
  pending = 0;
  const auto handler = action == OnSignal::note ? note : end_soon;
  if (action == OnSignal::end_soon) on(SIGALRM, end_now);
  interrupt_before_ = watch(SIGINT, handler);
  terminate_before_ = watch(SIGTERM, handler);
}

SignalWatch::~SignalWatch() {
  ::sigaction(SIGINT, &interrupt_before_, nullptr);
  ::sigaction(SIGTERM, &terminate_before_, nullptr);
}

int pending_signal() noexcept {
  return pending;
}

Interrupted::Interrupted(int signal, const std::string& advice)
    : std::runtime_error(std::string(signal == SIGINT ? "interrupted (SIGINT) " : "terminated (SIGTERM) ") + advice),
      code_(signal == SIGINT ? ExitCode::interrupted : ExitCode::terminated) {}

}  // namespace tessera::app
