// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/vec3.h"

namespace tessera::render {

/// How many neighbours lie side by side, for kernels that compute with so many at once.
inline constexpr std::uint32_t kLanes = 4;

/// How many groups of them so many take.
constexpr std::size_t lanes_for(std::size_t size) noexcept {
  return (size + kLanes - 1) / kLanes;
}

/// As many numbers.
struct Lanes {
  double at[kLanes];

  double operator[](std::size_t lane) const noexcept { return at[lane]; }
  double& operator[](std::size_t lane) noexcept { return at[lane]; }
};

/// As many vectors, by component.
struct Vec3Lanes {
  Lanes x;
  Lanes y;
  Lanes z;

  Vec3 operator[](std::size_t lane) const noexcept { return {x[lane], y[lane], z[lane]}; }
  void set(std::size_t lane, const Vec3& a) noexcept {
    x[lane] = a.x;
    y[lane] = a.y;
    z[lane] = a.z;
  }
};

}  // namespace tessera::render
