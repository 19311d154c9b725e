// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/frustum.h"
#include "render/scene_data.h"
#include "render/tree_space.h"

namespace tessera::render {

/// One of the lines of a light, which all start in one point or run in one direction.
/// units:   tree space, relative to the grid's origin
/// error:   as floats of doubles; distance is rounded up
struct LightLine {
  float unit[3];    ///< the way the light travels, of length 1
  float across[3];  ///< where the line starts, perpendicular to `unit`; 0 for a point light
  float distance;   ///< from there to the point that it shines on
};

/// The lines of a light through a scene, cut into squares: of a point light by direction, on one face in front of the
/// spheres or, where it is among them, on the six of a cube; of a directional light by place on one face.
class LightGrid {
 public:
  /// A face has 2^kBits x 2^kBits squares at the finest.
  static constexpr unsigned kBits = 10;
  static constexpr std::uint32_t kSquares = 1U << kBits;

  /// The square of finest size that a line goes through.
  struct Place {
    std::uint32_t face;
    std::uint32_t x;
    std::uint32_t y;
  };

  /// Nothing for a light so far away that floats cannot tell its lines apart, or in a scene without spheres.
  /// shapes:  a direction of any length > 0
  static std::optional<LightGrid> of(const TreeSpace& space, const Light& light);

  bool is_point() const noexcept { return kind_ == Pencil::Kind::pyramid; }
  std::uint32_t faces() const noexcept { return static_cast<std::uint32_t>(faces_.size()); }
  /// Where lines start, in tree space: the light, or for a directional one a point before all spheres.
  Vec3 origin() const noexcept { return space_.from_scene(origin_); }
  /// The way that a directional light travels, of length 1.
  const Vec3& direction() const noexcept { return faces_[0].axis; }

  /// Nothing for a line that meets no sphere, and for one to a point so far away that the two ends do not tell how it
  /// runs among the spheres.
  std::optional<Place> place_of(const LightLine& line) const noexcept;

  /// The lines of a square 2^bits squares wide that has `place` in it, and a little more than them.
  Pencil pencil(const Place& place, unsigned bits) const noexcept;

 private:
  /// Lines through axis + x right + y up, or from x right + y up along axis; |x|, |y| <= 1 is what the face shows.
  struct Face {
    Vec3 axis;  ///< of length 1
    Vec3 right;
    Vec3 up;
    // For place_of.
    std::array<float, 3> ahead;
    std::array<float, 3> to_x;
    std::array<float, 3> to_y;
  };

  LightGrid(const TreeSpace& space, const Vec3& origin, Pencil::Kind kind)
      : space_(space), origin_(origin), kind_(kind) {}
  void add_face(const Vec3& axis, double half_width);

  TreeSpace space_;
  Vec3 origin_;  ///< in scene coordinates: what pencils begin with, without another rounding
  Pencil::Kind kind_;
  std::vector<Face> faces_;
};

}  // namespace tessera::render
