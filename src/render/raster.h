// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "render/camera.h"
#include "render/frustum.h"
#include "render/region.h"
#include "render/scene.h"
#include "render/stream.h"

// Which sphere camera rays meet first, found for a block of them at a time by drawing the spheres: a sphere is looked
// at once for all rays of the block, and only the rays in a rectangle around its outline look at it. It is done in
// float and only ever leaves out what surely is not first: what it cannot tell, it leaves to nearest_hits.
namespace tessera::render {

/// What is known of the spheres that a ray enters: the first, or SurfaceId::none for none at all, or this.
inline constexpr SurfaceId kUnsureSphere{0xFFFF'FFFE};

/// What drawing has cost so far beside tracing, so that it is left off where it does not pay.
class DrawingRecord {
 public:
  /// In cycles or so, of one ray.
  static constexpr std::uint64_t kTracingCost = 250;

  /// Whether drawing has told enough of what it was asked, and for less than tracing would have cost.
  bool pays() const noexcept { return kTrials * cost_ <= kTracingCost * asked_; }

  void add(std::uint64_t rays, std::uint64_t cost) noexcept {
    asked_ += kTrials * rays;
    cost_ += cost;
    if (asked_ < kTrials * kMemory) return;
    asked_ /= 2;
    cost_ /= 2;
  }
  /// Of rays that were not asked for: after many it is worth another try.
  void skip(std::uint64_t rays) noexcept { asked_ += rays; }

 private:
  static constexpr std::uint64_t kMemory = 1 << 16;
  /// Where drawing does not pay, one ray in so many is drawn.
  static constexpr std::uint64_t kTrials = 16;

  std::uint64_t asked_ = 0;  ///< rays, times kTrials
  std::uint64_t cost_ = 0;
};

namespace avx2 {

/// Draws the spheres that rays from one eye may enter.
///
/// error:   In tree units, with O the eye, C and r of a sphere, M = |C| + |O| (sums of sizes), f = C - O, and all in
///          float: the foot f.d is off by less than 6 2^-24 M (2 from rounding and subtracting C and O, 1 from the
///          direction, 3 from the products), the perpendicular's length q by less than E = 2^-19 M (see TreeRay). The
///          radius, for which the leaf's is taken less the share of C in E, is off by 2^-19 R, R being the leaf's. So
///          with B = E + 2^-18 R, where q <= r or the computed one is, r^2 - q^2 is off by less than
///          B (2 R + B) + 2^-21 R^2 for the float squares; W = B (2 R + 3 B) outweighs it. Hence the line surely
///          passes where x = r^2 - q^2 < -W, surely enters where x > W, and the half chord is from sqrt(x - W) to
///          sqrt(x + W). With twice the foot's error and more, D = E / 2 = 16 2^-24 M, for their roundings, as
///          r <= |f| <= M for an eye outside, the entry is from foot - D - sqrt(x + W) to foot + D - sqrt(x - W).
///          An eye outside sees a sphere ahead whose foot is at t > 0.
///          Columns: the sphere reaches over the plane of a column at X (in units of the picture plane) only where
///          |f.right - X f.forward| <= r sqrt(1 + X^2). Left side: off by 6 sqrt(3) 2^-24 M sqrt(1 + X^2), less than
///          what R + 2^-19 |O| has more than r. The quotient of both is off by 2^-18 columns, kMargin outweighs it.
class Raster {
 public:
  /// Rays of a block are up to so many columns and rows.
  static constexpr std::size_t kSide = 16;

  /// requires: the camera's projection is a perspective, `region` is that of all its rays; all outlive the raster
  Raster(const Scene& scene, const CameraRays& camera, const Region& region) noexcept;

  /// Finds what is known of the rays through all (x, y) of the picture. Returns whether any may enter a sphere at all.
  /// shapes:  x and y ascend in equal steps, 1 <= size <= kSide
  bool draw(std::span<const double> x, std::span<const double> y, DrawingRecord& record) noexcept;

  /// What was found of one of these rays; only where draw returned true.
  SurfaceId first_sphere(std::size_t column, std::size_t row) const noexcept { return first_[row * kSide + column]; }

 private:
  static constexpr std::size_t kRays = kSide * kSide;
  static constexpr float kMargin = 0x1p-8F;
  /// An eye farther off, in tree units, is not known to a float.
  static constexpr double kFarthest = 0x1p20;
  static constexpr double kLeastStep = 0x1p-60;

  // In cycles or so. An unsure ray is traced after all; a block that costs several times as much as to trace it is not
  // drawn to its end.
  static constexpr std::uint64_t kMostPerRay = 4 * DrawingRecord::kTracingCost;
  static constexpr std::uint64_t kNodeCost = 50;
  static constexpr std::uint64_t kLeafCost = 80;
  static constexpr std::uint64_t kSphereCost = 30;
  static constexpr std::uint64_t kLanesCost = 15;

  /// Rows or columns of the block: where a sphere at f from the eye reaches over.
  struct Lines {
    float normal[3];  ///< f.normal / f.forward is the number of the line
    float widening;   ///< for a radius of 1 and a depth of 1
    float last;       ///< number of the last line
  };
  /// What is wanted of a leaf's spheres, in lanes.
  struct alignas(32) Spheres {
    float f[3][kTreeWidth];
    float radius_squared[kTreeWidth];
    float slack[kTreeWidth];       ///< W
    float foot_slack[kTreeWidth];  ///< D
    std::uint32_t first_column[kTreeWidth];
    std::uint32_t last_column[kTreeWidth];
    std::uint32_t first_row[kTreeWidth];
    std::uint32_t last_row[kTreeWidth];
  };

  /// shapes:  the first and last of `count` lines, in multiples of `unit` times `size` on the picture plane
  Lines lines_of(const std::array<double, 2>& range, std::size_t count, const Vec3& unit, double size) const noexcept;
  /// Sets what the block's rays have in common.
  TreeFrustum place_block() noexcept;
  /// Returns whether that is done at this cost at most.
  bool draw_tree(const TreeFrustum& frustum, std::uint64_t most_cost) noexcept;
  /// Sets what the rays have of their own, once the first sphere reaches in.
  void begin() noexcept;
  void draw_leaf(const TreeLeaf& leaf) noexcept;
  void draw_sphere(const Spheres& spheres, std::size_t lane, SurfaceId id) noexcept;
  void note_farthest() noexcept;
  void settle() noexcept;
  void give_up() noexcept;

  const Scene& scene_;
  const CameraRays& camera_;
  const Region& region_;
  bool can_draw_;  ///< the eye is near enough to be known to a float, pixels wide enough not to overflow one
  float eye_[3];
  float eye_error_;  ///< 2^-19 |O|, and a little for numbers near 0
  float forward_[3];

  // Of the block.
  std::span<const double> x_;
  std::span<const double> y_;
  std::size_t lane_columns_;  ///< rounded up to whole lanes
  Lines columns_;
  Lines rows_;
  float closest_cosine_;  ///< of a ray's angle to forward, at most
  float latest_;          ///< no ray of the block has its first entry after this
  bool is_begun_;         ///< whether any ray may enter a sphere

  // Of its rays: of all spheres that are surely entered the one whose latest entry is earliest, and the earliest entry
  // of all others that may be entered.
  alignas(32) std::array<float, kRays> direction_[3];
  alignas(32) std::array<float, kRays> entry_low_;
  alignas(32) std::array<float, kRays> entry_up_;
  alignas(32) std::array<float, kRays> others_low_;
  alignas(32) std::array<SurfaceId, kRays> first_;

  std::uint64_t cost_;
};

/// nearest_hits for rays of whose spheres something is known.
/// shapes:  known.size() = points.size() = rays.size(); each the first sphere that its ray enters, or none, or
///          kUnsureSphere
void nearest_hits(const Scene& scene, std::span<const RayInRegion> rays, std::span<const SurfaceId> known,
                  std::span<std::optional<SurfacePoint>> points);

}  // namespace avx2
}  // namespace tessera::render
