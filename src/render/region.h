// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "render/scene.h"

// The part of space that a path runs through. Everything is opaque, so a path never crosses a surface: the spheres
// around the eye and its side of every plane hold for every point of the path. They are decided once, and no later
// decision has to be taken from a rounded point.
namespace tessera::render {

class Region {
 public:
  /// The region in which a ray from `placement` along `direction` starts. A surface exactly at the eye has been
  /// left, to the side that the ray points to.
  Region(const Scene& scene, const Placement& placement, const Vec3& eye, const Vec3& direction);

  /// The spheres that the whole path is inside of and whose far sides it can meet, ascending: of coincident ones the
  /// first alone, for that is the one to be seen.
  const std::vector<SurfaceId>& walls() const noexcept { return walls_; }
  bool is_inside(SurfaceId sphere) const noexcept { return Placement::holds(enclosing_, sphere); }
  /// Whether no sphere is around the path.
  bool is_open() const noexcept { return enclosing_.empty(); }
  /// +1 on the side that the plane's normal points to, -1 on the other.
  int side_of(std::size_t plane) const noexcept { return plane_sides_[plane]; }

 private:
  std::vector<SurfaceId> enclosing_;  ///< ascending
  std::vector<SurfaceId> walls_;
  std::vector<std::int8_t> plane_sides_;
};

}  // namespace tessera::render
