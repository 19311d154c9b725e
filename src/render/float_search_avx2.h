// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "render/bvh.h"
#include "render/lanes_avx2.h"
#include "render/perpendicular_avx2.h"
#include "render/search.h"

#if defined(__x86_64__)

// What rays ask of spheres, decided in float as far as floats can tell: how far along its ray a sphere is entered is
// known to an interval, and most of those do not overlap. Only where they do, or where it is not sure that a sphere is
// entered at all, the searches of search.h are asked.
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {

/// Of an entry that may not take place at all.
inline constexpr float kNever = std::numeric_limits<float>::infinity();

/// Spheres that rays may meet, from the leaves that many rays come to.
///
/// error:   As in raster.h, where it is proved for rays from one eye: with E = 2^-19 (|C| + |O|), r the leaf's radius
///          less the share of C in E, B = E + 2^-18 r and x = r^2 - q^2 from the perpendicular's length q, the line
///          surely enters where x > W = B (2 r + 3 B), and with D = E / 2 the entry is from foot - D - sqrt(x + W) to
///          foot + D - sqrt(x - W), as no ray starts farther inside of a sphere than rounding puts it. r being that
///          of the leaf, less 2^-19 |C|, changes W by less than 2^-18 of itself, of which it has a third to spare.
///          TreeRay::sphere_error is 2^-19 |O| and more: twice what the ray's start is off by is in D, and 4 times
///          the floor of TreeSpace, which the leaf's radius was widened by
class Candidates {
 public:
  /// Where a ray enters a sphere.
  /// units:   distances along the ray in tree space
  struct Bounds {
    float low;
    float up;       ///< not below 0, like the entry itself; kNever unless it is surely entered
    float foot_up;  ///< of the point nearest to the centre
  };

  /// There is room for the leaves of so many rays, one of each.
  static constexpr std::size_t kRays = 32;

  std::size_t size() const noexcept { return size_; }
  /// The number of the ray.
  std::uint32_t ray(std::size_t i) const noexcept { return ray_[i]; }
  SurfaceId sphere(std::size_t i) const noexcept { return id_[i]; }
  /// requires: finish() has been called
  Bounds bounds(std::size_t i) const noexcept { return {square_[i], radius_[i], foot_[i]}; }

  /// Adds the spheres of a leaf but the one that the ray leaves: those that it may enter before `latest`, or, unless
  /// kEntered, whose centres it may pass before.
  template <bool kEntered>
  void add(const TreeLeaf& leaf, std::uint32_t number, const TreeRay& ray, SurfaceId from, float latest) noexcept {
    const auto [foot, square] = perpendicular(leaf, ray.origin, ray.direction);
    const Int8 ids = Int8::load(leaf.id);
    const Float8 radius = Float8::load(leaf.radius);
    const Float8 reach = radius + Float8::all(ray.sphere_error);
    const auto center_size = [&](int axis) { return Float8::load(leaf.center[axis]).size(); };
    const Float8 center_error =
        Float8::all(static_cast<float>(TreeRay::kSphereError)) * (center_size(0) + center_size(1) + center_size(2));
    const Float8 error = center_error + Float8::all(ray.sphere_error);
    const Float8 foot_error = Float8::all(0.5F) * error;
    const Float8 begin = foot - (kEntered ? reach : foot_error);
    const LaneMask met = (square <= reach * reach) & (Float8::all(0) <= foot + foot_error) &
                         (begin <= Float8::all(latest)) & ~negative_lanes(radius) &
                         ~lanes_equal(ids, static_cast<std::uint32_t>(from));

    const Int8 lanes = lanes_in_order(met, 0);
    Int8::all(number).store(ray_ + size_);
    picked(ids, lanes).store(id_ + size_);
    picked(foot, lanes).store(foot_ + size_);
    picked(square, lanes).store(square_ + size_);
    picked(radius - center_error, lanes).store(radius_ + size_);
    picked(error, lanes).store(error_ + size_);
    size_ += static_cast<std::size_t>(std::popcount(met));
  }

  /// Finds the bounds of all, in the places of what they are computed from.
  void finish() noexcept {
    const Float8 zero = Float8::all(0);
    for (float* column : {foot_, square_, radius_, error_}) zero.store(column + size_);
    for (std::size_t i = 0; i < size_; i += kTreeWidth) {
      const Float8 foot = Float8::load(foot_ + i);
      const Float8 radius = Float8::load(radius_ + i);
      const Float8 error = Float8::load(error_ + i);
      const Float8 off = fused(radius, Float8::all(0x1p-18F), error);
      const Float8 slack = off * fused(Float8::all(3), off, radius + radius);
      const Float8 inside = radius * radius - Float8::load(square_ + i);
      const Float8 least = inside - slack;
      const Float8 foot_error = Float8::all(0.5F) * error;
      const Float8 early = foot - foot_error;
      const Float8 late = foot + foot_error;
      const Float8 low = early - sqrt(max(inside + slack, zero));
      const Float8 up = max(late - sqrt(max(least, zero)), zero);
      low.store(square_ + i);
      where_less(zero, min(least, early), up, Float8::all(kNever)).store(radius_ + i);
      late.store(foot_ + i);
    }
  }

 private:
  // Lanes beyond the last sphere are written too.
  static constexpr std::size_t kRoom = (kRays + 1) * kTreeWidth;

  std::size_t size_ = 0;
  alignas(32) std::uint32_t ray_[kRoom];
  alignas(32) SurfaceId id_[kRoom];
  alignas(32) float foot_[kRoom];    ///< later where it is at the latest
  alignas(32) float square_[kRoom];  ///< of the perpendicular; later where the sphere is entered at the earliest
  alignas(32) float radius_[kRoom];  ///< later where it is entered at the latest
  alignas(32) float error_[kRoom];   ///< E
};

/// NearestSearch, asked only where floats cannot tell.
class FloatNearestSearch {
 public:
  /// Whether latest() comes nearer with what is found.
  static constexpr bool kCanShorten = true;

  FloatNearestSearch(const Scene& scene, const Ray& ray, const Region& region) noexcept
      : scene_(&scene), ray_(&ray), region_(&region), first_low_(region.is_open() ? kNever : -kNever) {
    if (!scene.visible_planes().empty() || !region.walls().empty()) exact_.emplace(scene, ray, region);
  }

  /// Tells how the tree sees the ray.
  void set_end(const TreeRay&) noexcept {}
  /// No hit after this can be the first, as far as the exact search knows.
  double latest() const noexcept { return exact_ ? exact_->latest() : std::numeric_limits<double>::infinity(); }
  /// Whether the search is at its end.
  static constexpr bool is_over() noexcept { return false; }

  /// Takes a sphere into account and `latest` nearer, unless it returns that floats cannot tell.
  bool cannot_tell(SurfaceId id, const Candidates::Bounds& bounds, float& latest) noexcept {
    const bool may_be_first = bounds.low <= latest;
    const bool is_first = may_be_first & (bounds.up < first_low_);
    first_low_ = is_first ? bounds.low : first_low_;
    first_ = is_first ? id : first_;
    latest = is_first ? std::min(bounds.up, latest) : latest;
    return may_be_first & !is_first;
  }
  /// Has such a sphere decided exactly.
  void offer(SurfaceId id) noexcept {
    if (!exact_) exact_.emplace(*scene_, *ray_, *region_);
    exact_->offer(id);
  }

  /// At the end: the sphere that floats say is entered first, if any.
  SurfaceId first() const noexcept { return first_; }
  /// At the end: the search that knows of all surfaces that may be met first; none where there is no other than
  /// first().
  NearestSearch* exact() noexcept {
    if (!exact_) return nullptr;
    if (first_ != SurfaceId::none) exact_->offer(first_);
    return &*exact_;
  }

 private:
  const Scene* scene_;
  const Ray* ray_;
  const Region* region_;
  // The last sphere that was surely entered, and surely before all others from which floats took it: the exact search
  // has been offered the rest. Nothing is sure where the ray is inside of some: then no sphere can begin before.
  float first_low_;
  SurfaceId first_ = SurfaceId::none;
  std::optional<NearestSearch> exact_;
};

/// OcclusionSearch, asked only where floats cannot tell.
class FloatOcclusionSearch {
 public:
  static constexpr bool kCanShorten = false;

  FloatOcclusionSearch(const Scene& scene, const Ray& to_light, double end, std::size_t light,
                       const Region& region) noexcept
      : scene_(&scene), ray_(&to_light), region_(&region), light_(light), end_(end) {}

  void set_end(const TreeRay& ray) noexcept {
    // What is around the ray or touches its end need not stand in its way.
    const bool is_plain = region_->is_open() && scene_->light_placement(light_).touching.empty();
    sure_end_ = is_plain ? ray.least_t_of(end_) : -kNever;
  }
  double latest() const noexcept { return end_; }
  bool is_over() const noexcept { return is_occluded_; }

  bool cannot_tell(SurfaceId, const Candidates::Bounds& bounds, const float&) noexcept {
    const bool stands = (bounds.up < kNever) & (bounds.foot_up <= sure_end_);
    is_occluded_ |= stands;
    return !stands;
  }
  void offer(SurfaceId id) noexcept {
    if (is_occluded_) return;
    if (!exact_) exact_.emplace(*scene_, *ray_, end_, light_, *region_);
    is_occluded_ = exact_->offer(id);
  }

  bool is_occluded() const noexcept { return is_occluded_; }

 private:
  const Scene* scene_;
  const Ray* ray_;
  const Region* region_;
  std::size_t light_;
  double end_;
  float sure_end_ = -kNever;  ///< the light comes after this, in tree space
  bool is_occluded_ = false;
  std::optional<OcclusionSearch> exact_;
};

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#endif
