// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace tessera::render {

/// How spheres are searched. Every kernel gives the same picture, bit for bit.
enum class Kernel : std::uint8_t {
  automatic,  ///< the fastest that this machine can run
  scalar,     ///< through the tree, ray by ray: what faster ones must match
  avx2,       ///< through the tree, many rays at a time, each step of a ray in vector instructions
  brute,      ///< every sphere for every ray: the oracle
};

/// Whether this machine can run it.
bool is_supported(Kernel kernel) noexcept;

/// The kernel itself, or for Kernel::automatic the one that it stands for here.
/// throws:  std::invalid_argument where this machine cannot run it
Kernel runnable(Kernel kernel);

}  // namespace tessera::render
