// SPDX-License-Identifier: BSD-3-Clause
#include "app/interruption.h"

#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <string>
#include <thread>

namespace tessera::app {
namespace {

using namespace std::chrono_literals;

/// The status, as waitpid tells it, of a process that does this and then ends with code 7.
template <class Action>
int status_after(Action&& action) {
  const ::pid_t child = ::fork();
  if (child == 0) {
    action();
    ::_exit(7);
  }
  int status = 0;
  BOOST_TEST_REQUIRE(::waitpid(child, &status, 0) == child);
  return status;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(Interruption)

BOOST_AUTO_TEST_CASE(a_signal_waits_until_somebody_looks) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const SignalWatch watch(OnSignal::note);
    BOOST_TEST(pending_signal() == 0);
    std::raise(signal);
    BOOST_TEST(pending_signal() == signal);
  }
  const SignalWatch watch(OnSignal::note);
  BOOST_TEST(pending_signal() == 0);
}

BOOST_AUTO_TEST_CASE(a_second_one_ends_the_process_at_once) {
  for (const OnSignal action : {OnSignal::note, OnSignal::end_soon}) {
    const int status = status_after([&] {
      const SignalWatch watch(action);
      std::raise(SIGTERM);
      std::raise(SIGTERM);
    });
    BOOST_TEST((WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM));
  }
}

BOOST_AUTO_TEST_CASE(a_process_that_is_to_end_soon_goes_on_for_a_quarter_of_a_second) {
  const auto start = std::chrono::steady_clock::now();
  const int status = status_after([] {
    const SignalWatch watch(OnSignal::end_soon);
    std::raise(SIGINT);
    std::this_thread::sleep_for(20s);
  });
  const auto took = std::chrono::steady_clock::now() - start;
  BOOST_TEST((WIFEXITED(status) && WEXITSTATUS(status) == 130));
  BOOST_TEST((took >= 240ms && took < 10s));
}

BOOST_AUTO_TEST_CASE(what_was_ignored_stays_ignored) {
  const int status = status_after([] {
    std::signal(SIGINT, SIG_IGN);
    const SignalWatch watch(OnSignal::note);
    std::raise(SIGINT);
    std::raise(SIGINT);
    if (pending_signal() != 0) ::_exit(1);
  });
  BOOST_TEST((WIFEXITED(status) && WEXITSTATUS(status) == 7));
}

BOOST_AUTO_TEST_CASE(afterwards_signals_do_what_they_did_before) {
  const int status = status_after([] {
    { const SignalWatch watch(OnSignal::note); }
    std::raise(SIGINT);
  });
  BOOST_TEST((WIFSIGNALED(status) && WTERMSIG(status) == SIGINT));
}

BOOST_AUTO_TEST_CASE(the_exit_code_is_what_a_shell_would_say) {
  const Interrupted interrupted(SIGINT, "do this");
  BOOST_TEST(static_cast<int>(interrupted.code()) == 130);
  BOOST_TEST(interrupted.what() == std::string("interrupted (SIGINT) do this"));
  const Interrupted terminated(SIGTERM, "do that");
  BOOST_TEST(static_cast<int>(terminated.code()) == 143);
  BOOST_TEST(terminated.what() == std::string("terminated (SIGTERM) do that"));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::app
