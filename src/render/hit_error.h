// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "render/exact.h"
#include "render/ray.h"
#include "render/scene_data.h"

// How far rounding has taken a ray and what it meets from where exact arithmetic would have them.
//
// A hit on a sphere of radius r at distance T and angle theta turns a displacement D = line + T direction of the ray
// into D / cos theta of the hit and D / (r cos theta) of the normal; a mirror adds twice the latter to the direction
// and leaves the line D off, as a mirror image would be. Hits on the inner side of one sphere grow linearly instead.
//
// All is of first order. For the second, each growth is taken 1 % larger than it is, and beyond 2^-10 there is no
// bound.
namespace tessera::render {

/// What a few operations may round a unit vector or a cosine by.
inline constexpr double kUnitRounding = 16 * kUnitRoundoff;
/// For the second order of what is treated as linear, as long as it is below the limit.
inline constexpr double kSecondOrder = 1.01;
inline constexpr double kLinearLimit = 0x1p-10;

/// Of a ray; all 0 for a camera ray, which is what it is.
struct RayError {
  double position = 0;   ///< of the origin
  double line = 0;       ///< the same across the direction
  double direction = 0;  ///< relative to its length

  /// How far off the line may be at a distance from the origin.
  double shift_at(double distance) const noexcept { return kSecondOrder * (line + direction * (distance + position)); }
};

/// Of a hit.
struct HitError {
  RayError mirrored;  ///< of the ray that a mirror would send on from here; its origin is the hit
  double normal = 0;  ///< of the unit normal
  double latest = 0;  ///< the distance from the ray's origin is at most this
};

/// Which side of a sphere is hit.
enum class SphereSide : std::uint8_t { outer, inner };

/// Of a hit on a sphere that the ray has not just left, or nullopt where it cannot be bounded.
std::optional<HitError> error_of_hit(const Sphere& sphere, SphereSide side, const Ray& ray, const Hit& hit,
                                     const RayError& error) noexcept;

/// Of a hit on a plane, from side `side`.
std::optional<HitError> error_of_hit(const Plane& plane, int side, const Ray& ray, const Hit& hit,
                                     const RayError& error) noexcept;

/// How far off the length of a chord may be that starts where the normal is off by `normal_error`.
double error_of_chord(double radius, double normal_error, const RayError& error) noexcept;

/// Hits one after the other on the inner side of one sphere.
class InnerRun {
 public:
  InnerRun() = default;
  /// The first of them, met from elsewhere.
  explicit InnerRun(const HitError& first) noexcept : start_error_(first.normal + first.mirrored.direction) {}

  /// Of the next hit, at the other end of the chord from the last one.
  std::optional<HitError> next(const Sphere& sphere, const Hit& hit, double chord, double chord_error) noexcept;

 private:
  double start_error_ = 0;  ///< of the normal and the direction that it began with, together
  double count_ = 0;        ///< of hits since
};

}  // namespace tessera::render
