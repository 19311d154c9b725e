// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/chunk.h"

#include <algorithm>
#include <cmath>

namespace tessera::scheduler {
namespace {

constexpr std::uint64_t ceil_div(std::uint64_t a, std::uint64_t b) noexcept {
  return a / b + (a % b != 0);
}

/// A chunk of the sequence f, f - step, f - 2 step, ... of which `taken` is out. Chunk k begins at
/// taken = k f - step k (k - 1) / 2; solved for k, f - step k is what stands here, and it is just as good in between.
double falling_chunk(double first, double step, double taken) noexcept {
  const double top = first + step / 2;
  return std::sqrt(std::max(0.0, top * top - 2 * step * taken)) - step / 2;
}

}  // namespace

std::uint32_t guided_chunk(std::uint32_t remaining, std::uint32_t ranks) noexcept {
  return static_cast<std::uint32_t>(ceil_div(remaining, ranks));
}

double guided_chunk_s(double remaining_s, std::uint32_t ranks) noexcept {
  return remaining_s / ranks;
}

std::uint32_t factoring_chunk(std::uint32_t tasks, std::uint32_t remaining, std::uint32_t ranks) noexcept {
  // Find the batch that what remains lies in.
  std::uint64_t at_start = tasks;
  for (;;) {
    const std::uint64_t chunk = ceil_div(at_start, 2 * std::uint64_t{ranks});
    if (chunk * ranks >= at_start || at_start - chunk * ranks < remaining) return static_cast<std::uint32_t>(chunk);
    at_start -= chunk * ranks;
  }
}

double factoring_chunk_s(double tasks_s, double remaining_s, std::uint32_t ranks) noexcept {
  if (remaining_s <= 0) return 0;
  const double halvings = std::max(0.0, std::floor(std::log2(tasks_s / remaining_s)));
  return std::ldexp(tasks_s, -static_cast<int>(halvings)) / (2.0 * ranks);
}

std::uint32_t trapezoid_chunk(std::uint32_t tasks, std::uint32_t remaining, std::uint32_t ranks) noexcept {
  const double first = std::max(1.0, std::ceil(tasks / (2.0 * ranks)));
  const double chunks = std::ceil(2.0 * tasks / (first + 1));
  const double step = chunks > 1 ? (first - 1) / (chunks - 1) : 0;
  const double chunk = falling_chunk(first, step, static_cast<double>(tasks) - remaining);
  return static_cast<std::uint32_t>(std::max(1L, std::lround(chunk)));
}

double trapezoid_chunk_s(double tasks_s, double remaining_s, std::uint32_t ranks) noexcept {
  const double first = tasks_s / (2.0 * ranks);
  return falling_chunk(first, first / (4.0 * ranks), tasks_s - remaining_s);
}

}  // namespace tessera::scheduler
