// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

#include "render/ray.h"
#include "render/scene_data.h"

namespace tessera::render {

/// What the paths of a pixel decided, whatever colour came of it: the surfaces that they met in turn, and which lights
/// reached them there. Equal signatures mean equal decisions, up to a chance of 2^-64.
struct Signature {
  std::uint64_t surfaces = 0;         ///< hash of all that was met, the cell of a checker board included
  std::uint64_t lights = 0;           ///< hash of a bit per light at every surface that shows light
  std::uint32_t hits = 0;             ///< surfaces met in all
  SurfaceId first = SurfaceId::none;  ///< what the first path met first

  friend bool operator==(const Signature&, const Signature&) = default;

  void meet(SurfaceId surface, Cell cell) noexcept {
    if (surfaces == 0) first = surface;
    ++hits;
    surfaces = mixed(surfaces, 2 * std::uint64_t{index_of(surface)} + static_cast<std::uint64_t>(cell));
  }
  /// A ray left the scene.
  void miss() noexcept { surfaces = mixed(surfaces, 2 * std::uint64_t{index_of(SurfaceId::none)}); }

  void light(bool is_lit) noexcept { lights = mixed(lights, is_lit ? 2 : 1); }

 private:
  /// A multiplication by an odd number near 2^64 / golden ratio spreads every bit upwards, the rotation takes it down.
  static constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) noexcept {
    return (std::rotl(hash, 29) ^ (value + 1)) * 0x9E3779B97F4A7C15u;
  }
};
static_assert(sizeof(Signature) == 24);

}  // namespace tessera::render
