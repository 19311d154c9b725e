// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "app/shared_arrays.h"
#include "io/stats.h"
#include "render/scene.h"

// What a render takes of a machine's memory.
namespace tessera::app {

/// One copy of a scene's spheres, materials and tree, in bytes.
std::uint64_t memory_bytes(const render::Scene& scene) noexcept;

/// What this process has in memory and shares with nothing, neither a file nor another process, in bytes; 0 where the
/// system does not say.
std::uint64_t private_bytes() noexcept;

/// What a scene takes at present, and this process besides.
io::Stats::Memory memory_of(const render::Scene& scene, const Copies& copies) noexcept;

}  // namespace tessera::app
