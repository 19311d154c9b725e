// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>

#include "app/options.h"

// How far a render is, on stderr, for a person who waits.
namespace tessera::app {

/// Whether this process itself talks to a terminal. Under a launcher nothing is said of that: every stream is a pipe
/// or looks like a terminal, so lines are printed there.
enum class Surroundings : std::uint8_t { terminal, pipe, launcher };

Surroundings surroundings();

class Progress {
 public:
  /// What `automatic` means: a bar on a terminal, a line every few seconds under a launcher, nothing into a pipe.
  Progress(ProgressStyle style, Surroundings where, std::size_t pixels);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts pixels that are done; prints when it is time to.
  void advance(std::size_t pixels);

  /// Clears the bar. Whatever is printed next starts on an empty line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void print(double elapsed_s);

  ProgressStyle style_;
  std::size_t pixels_;
  std::size_t done_ = 0;
  Clock::time_point start_;
  Clock::time_point next_;
  bool bar_is_drawn_ = false;
};

}  // namespace tessera::app
