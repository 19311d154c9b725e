// SPDX-License-Identifier: BSD-3-Clause
#include "render/hit_error.h"

#include <cmath>

#include "render/plane.h"
#include "render/sphere.h"

namespace tessera::render {
namespace {

constexpr double u = kUnitRoundoff;

/// The ray in a length of direction that can be squared, as nearest_hit() takes it.
Ray squarable(Ray ray) noexcept {
  int exponent = 0;
  ray.direction = rescaled(ray.direction, exponent);
  return ray;
}

}  // namespace

// The hit is off by shift / cosine along the surface, and so the mirrored ray by shift across its direction. Within the
// limit on that the cosine itself changes by less than 1 %.
std::optional<HitError> error_of_hit(const Sphere& sphere, SphereSide side, const Ray& given_ray, const Hit& hit,
                                     const RayError& error) noexcept {
  const auto& [center, radius, material] = sphere;
  const Ray ray = squarable(given_ray);
  const DirectionNorm norm = norm_of(ray.direction);
  const Passage passage = passage_of(ray, norm, center, radius);
  const double rounding = half_chord(passage).error / (radius * norm.length) + kUnitRounding +
                          kUnitRounding * u * length(passage.f.hi) / radius;
  const double cosine = std::abs(dot(hit.normal, ray.direction)) / norm.length - rounding - kUnitRounding;
  if (!(cosine > 0) || error.direction > kLinearLimit * cosine) return std::nullopt;

  const auto crossing = side == SphereSide::inner ? std::optional(exit_from(ray, norm, center, radius))
                                                  : entry_into(ray, norm, center, radius);
  if (!crossing) return std::nullopt;
  const double distance = crossing->t.value * norm.length;
  const double shift = error.shift_at(distance);
  const double along = kSecondOrder * shift / cosine;
  if (along > kLinearLimit * radius * cosine) return std::nullopt;

  const double rounded = radius * rounding + 2 * u * (radius + length(hit.point));
  HitError result;
  result.normal = along / radius + rounding;
  result.mirrored.position = along + rounded;
  result.mirrored.line = kSecondOrder * shift + rounded;
  result.mirrored.direction = error.direction + 2 * result.normal + kUnitRounding;
  result.latest = distance + along + crossing->t.error * norm.length;
  return result;
}

std::optional<HitError> error_of_hit(const Plane& plane, int side, const Ray& given_ray, const Hit& hit,
                                     const RayError& error) noexcept {
  const Ray ray = squarable(given_ray);
  const double direction_length = length(ray.direction);
  const double cosine = std::abs(dot(hit.normal, ray.direction)) / direction_length - kUnitRounding;
  if (!(cosine > 0) || error.direction > kLinearLimit * cosine) return std::nullopt;

  const auto t = distance_to(plane, ray, side);
  if (!t) return std::nullopt;
  const double distance = t->value * direction_length;
  const double shift = error.shift_at(distance);
  const double along = kSecondOrder * shift / cosine;
  const double late = t->error * direction_length;
  const double rounded = late + 4 * u * (length(ray.origin) + distance);

  HitError result;
  result.normal = kUnitRounding;
  result.mirrored.position = along + rounded;
  result.mirrored.line = kSecondOrder * shift + rounded;
  result.mirrored.direction = error.direction + 2 * result.normal + kUnitRounding;
  result.latest = distance + along + late;
  return result;
}

double error_of_chord(double radius, double normal_error, const RayError& error) noexcept {
  return 2 * kSecondOrder * radius * (normal_error + error.direction + kUnitRounding);
}

// Normal and direction turn by the same angle from hit to hit, in the plane of both. Errors a and b that they begin
// with have grown to at most (1 + 4m)(a + b) after m hits: in the plane by twice the angle's error a hit, across it
// because N_m = p N_0 + q D_0 with |p| <= 1 + 2m, |q| <= 2m (|sin 2mx| <= 2m |sin x|). Every hit adds roundings, which
// grow on.
std::optional<HitError> InnerRun::next(const Sphere& sphere, const Hit& hit, double chord,
                                       double chord_error) noexcept {
  const double m = ++count_;
  const double error = kSecondOrder * (1 + 4 * m) * start_error_ + 2 * kUnitRounding * m * (1 + 2 * m);
  if (!(error < kLinearLimit)) return std::nullopt;
  const double position = sphere.radius * error + 2 * u * (sphere.radius + length(hit.point));
  return HitError{{position, position, error}, error, chord + chord_error};
}

}  // namespace tessera::render
