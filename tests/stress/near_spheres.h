// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "render/scene_data.h"

// A conservative filter in plain double precision: the few spheres of millions that a ray could meet first, or that
// could stand between its two ends. What it leaves out cannot matter to a ray that is off by 1e-9 of the way and 1e-15
// of the origin's coordinates, so a reference that is given the rest answers as if it were given all.
namespace tessera::stress {

/// Where a ray runs. No end of it is inside of a sphere.
struct Segment {
  render::Vec3 origin;
  render::Vec3 direction;
  double end = std::numeric_limits<double>::infinity();  ///< in multiples of direction; beyond, nothing matters
  bool is_shadow = false;                                ///< any sphere between the ends is as good as the first
};

/// For each segment the indices of the spheres that could matter, by brute force.
std::vector<std::vector<std::uint32_t>> spheres_near(std::span<const render::Sphere> spheres,
                                                     const std::vector<Segment>& segments);

}  // namespace tessera::stress
