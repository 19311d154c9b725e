// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "render/random.h"
#include "render/scene_data.h"

namespace tessera::render::test {

/// Spheres in a box of half side `extent` about `center`, radii over `decades` below a third of it.
inline std::vector<Sphere> cloud(Random& random, const Vec3& center, double extent, double decades, int count) {
  std::vector<Sphere> spheres;
  for (int i = 0; i != count; ++i) {
    const double radius = extent * random.over_decades(std::pow(10, -decades), 0.3);
    spheres.push_back({center + random.in_box(extent), radius, MaterialIndex{0}});
  }
  return spheres;
}

inline const Sphere& one_of(Random& random, const std::vector<Sphere>& spheres) {
  return spheres[random.below(static_cast<std::uint32_t>(spheres.size()))];
}

}  // namespace tessera::render::test
