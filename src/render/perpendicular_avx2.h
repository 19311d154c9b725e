// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/bvh.h"
#include "render/lanes_avx2.h"

#if defined(__x86_64__)
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {

/// How lines pass eight points.
struct Perpendicular {
  Float8 foot;    ///< where on the line it stands
  Float8 square;  ///< of its length
};

/// From points at f to lines through the origin along unit vectors d.
inline Perpendicular perpendicular(Float8 fx, Float8 fy, Float8 fz, Float8 dx, Float8 dy, Float8 dz) noexcept {
  const Float8 foot = fused(fz, dz, fused(fy, dy, fx * dx));
  const Float8 px = fused_minus(foot, dx, fx);
  const Float8 py = fused_minus(foot, dy, fy);
  const Float8 pz = fused_minus(foot, dz, fz);
  return {foot, fused(pz, pz, fused(py, py, px * px))};
}

/// From the centres of a leaf's spheres to one line.
inline Perpendicular perpendicular(const TreeLeaf& leaf, const float* start, const float* unit) noexcept {
  const auto from_start = [&](int axis) { return Float8::load(leaf.center[axis]) - Float8::all(start[axis]); };
  return perpendicular(from_start(0), from_start(1), from_start(2), Float8::all(unit[0]), Float8::all(unit[1]),
                       Float8::all(unit[2]));
}

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#endif
