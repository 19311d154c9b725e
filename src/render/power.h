// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Functions that a mathematical library computes differently from machine to machine, from additions,
// multiplications, divisions and std::fma alone: the same bits everywhere.
namespace tessera::render {

/// base^exponent.
/// shapes:  base >= 0, exponent >= 0; 0^0 = 1
/// error:   relative at most (8 + exponent) u, underflow aside
double power(double base, double exponent) noexcept;

/// tan(degrees).
/// shapes:  degrees in [0, 90)
/// error:   relative at most 8u
double tangent_of_degrees(double degrees) noexcept;

}  // namespace tessera::render
