// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

// How large the next chunk is when work is shared out in chunks that shrink. Each is a pure function of how much work
// there is, how much of it is left, and the number of ranks, so it does not matter who took the chunks before. In whole
// tasks they are the published ones; in seconds they are the same without the rounding.
namespace tessera::scheduler {

/// 1/P of what remains, rounded up.
/// source:  Polychronopoulos and Kuck, IEEE Trans. Computers C-36(12) (1987)
std::uint32_t guided_chunk(std::uint32_t remaining, std::uint32_t ranks) noexcept;
double guided_chunk_s(double remaining_s, std::uint32_t ranks) noexcept;

/// 1/(2P) of what remained when its batch of P equal chunks began, rounded up.
/// source:  Hummel, Schonberg and Flynn, CACM 35(8) (1992), with the ratio of 2 that needs no variances
std::uint32_t factoring_chunk(std::uint32_t tasks, std::uint32_t remaining, std::uint32_t ranks) noexcept;
double factoring_chunk_s(double tasks_s, double remaining_s, std::uint32_t ranks) noexcept;

/// Falls from f = N/(2P) to 1 in equal steps. Published are whole steps; where N < 8P^2 or so that would be no step at
/// all, so steps are fractions here and chunks are rounded.
/// source:  Tzen and Ni, IEEE Trans. Parallel Distrib. Syst. 4(1) (1993)
std::uint32_t trapezoid_chunk(std::uint32_t tasks, std::uint32_t remaining, std::uint32_t ranks) noexcept;
/// The same to 0, which is never reached.
double trapezoid_chunk_s(double tasks_s, double remaining_s, std::uint32_t ranks) noexcept;

}  // namespace tessera::scheduler
