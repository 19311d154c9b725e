// SPDX-License-Identifier: BSD-3-Clause
#include "app/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "scheduler/launcher.h"

namespace tessera::app {
namespace {

using namespace std::chrono_literals;
constexpr auto kLineInterval = 3s;
constexpr auto kBarInterval = 100ms;
constexpr std::size_t kBarWidth = 30;

ProgressStyle resolved(ProgressStyle style, Surroundings where) {
  if (style != ProgressStyle::automatic) return style;
  switch (where) {
    case Surroundings::terminal:
      return ProgressStyle::bar;
    case Surroundings::launcher:
      return ProgressStyle::plain;
    case Surroundings::pipe:
      break;
  }
  return ProgressStyle::none;
}

}  // namespace

Surroundings surroundings() {
  if (scheduler::launched_by_mpi()) return Surroundings::launcher;
  return isatty(STDERR_FILENO) != 0 ? Surroundings::terminal : Surroundings::pipe;
}

Progress::Progress(ProgressStyle style, Surroundings where, std::size_t pixels)
    : style_(resolved(style, where)), pixels_(pixels), start_(Clock::now()) {
  next_ = style_ == ProgressStyle::bar ? start_ + kBarInterval : start_ + kLineInterval;
}

void Progress::advance(std::size_t pixels) {
  done_ += pixels;
  if (style_ == ProgressStyle::none) return;
  const auto now = Clock::now();
  if (now < next_) return;
  print(std::chrono::duration<double>(now - start_).count());
  next_ = style_ == ProgressStyle::bar ? now + kBarInterval : now + kLineInterval;
}

void Progress::print(double elapsed_s) {
  const double share = static_cast<double>(done_) / static_cast<double>(pixels_);
  const double left_s = done_ > 0 ? elapsed_s / share - elapsed_s : 0;
  if (style_ == ProgressStyle::plain) {
    std::fprintf(stderr, "rendered %3.0f %%, %.0f s, about %.0f s left\n", 100 * share, elapsed_s, left_s);
    return;
  }
  const auto filled = static_cast<std::size_t>(share * static_cast<double>(kBarWidth));
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  std::fprintf(stderr, "\r[%s] %3.0f %%  %.0f s left ", bar.c_str(), 100 * share, left_s);
  std::fflush(stderr);
  bar_is_drawn_ = true;
}

void Progress::finish() {
  if (bar_is_drawn_) std::fprintf(stderr, "\r%*s\r", static_cast<int>(kBarWidth + 24), "");
  bar_is_drawn_ = false;
}

}  // namespace tessera::app
