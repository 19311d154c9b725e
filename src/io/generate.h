// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "render/scene_data.h"

// Spheres without a file: the scenes that renderers are compared on. They are computed with +, -, * and / alone, so
// every machine makes the same bits.
namespace tessera::io {

/// Every sphere carries nine children of a third of its radius that touch it: six around its equator and three at 55
/// degrees elevation, where the pole is the direction from its own parent. The root's pole is z.
struct Sphereflake {
  static constexpr std::uint32_t kMaxLevel = 7;  ///< 5,380,840 spheres

  std::uint32_t level = 4;  ///< generations below the root, <= kMaxLevel: (9^(level + 1) - 1) / 8 spheres
  render::Vec3 center{};    ///< of the root
  double radius = 0.5;      ///< of the root
  std::vector<render::MaterialIndex> materials;  ///< generation g takes materials[g % size]; not empty
};

/// Generation by generation, so the parent of sphere i is sphere (i - 1) / 9.
std::vector<render::Sphere> generate_sphereflake(const Sphereflake& flake);

/// Spheres at random in a cube, smaller the more there are, so that together they always fill as much of it.
struct Cloud {
  static constexpr std::uint64_t kMaxCount = 200'000'000;

  std::uint64_t count = 10'000;  ///< 1 ... kMaxCount
  std::uint64_t seed = 1;
  double fill = 0.7;                             ///< radii are uniform in 0.3 ... 1 times scale fill count^(-1/3)
  render::Vec3 center{};                         ///< of the cube
  double scale = 1;                              ///< centres are uniform in [-scale, scale]^3 around center
  std::vector<render::MaterialIndex> materials;  ///< picked at random; not empty
};

/// The same seed gives the same spheres whatever the materials.
std::vector<render::Sphere> generate_cloud(const Cloud& cloud);

}  // namespace tessera::io
