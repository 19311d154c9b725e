// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/exact.h"
#include "render/ray.h"
#include "render/scene_data.h"

// Where a line meets a sphere: the scalar specification that every faster kernel must match bit for bit.
//
// Hit or miss is read from Lagrange's identity (f.d)^2 - f^2 d^2 = -|f x d|^2 with f = C - O: compare the length
// l = |f x d| with R = r |d|. Neither is a difference of large numbers, so distance costs no accuracy; the
// textbook discriminant b^2 - 4ac loses all digits once the sphere is 1e8 radii away.
namespace tessera::render {

/// A direction with what every sphere test needs of it.
struct DirectionNorm {
  double squared = 0;  ///< a = d.d
  double length = 0;   ///< sqrt(a)
};

inline DirectionNorm norm_of(const Vec3& direction) noexcept {
  const double a = dot(direction, direction);
  return {a, std::sqrt(a)};
}

/// The power of `point` against a sphere, |C - point|^2 - r^2: < 0 inside, 0 on, > 0 outside.
/// shapes:  f = C - point, exactly
/// error:   as if computed in twice the precision and rounded once
inline double power_of_point(const ExactDifference& f, double radius) noexcept {
  CompensatedSum power;
  power.add_product(f.hi.x, f.hi.x);
  power.add_product(f.hi.y, f.hi.y);
  power.add_product(f.hi.z, f.hi.z);
  power.add_product(-radius, radius);
  power.add_small(2 * dot(f.hi, f.lo));
  return power.value();
}

/// How a line passes a sphere; both roots and both normals follow from it.
struct Chord {
  double discriminant;  ///< (R - l)(R + l): < 0 where the line misses, 0 where it touches
  double b;             ///< f.d
  double c;             ///< power of the origin
  double s;             ///< half the chord times |d|, 0 for a line that misses
  Vec3 w;               ///< f x d
};

/// True only for a sphere that the ray cannot meet from outside: passed at a distance or lying behind, by more
/// than the rounding error of this test. False decides nothing.
/// error:   f, its products and their sums are off by at most 8u |f||d|, so l^2 and b by the guards below
inline bool surely_misses(const Ray& ray, const DirectionNorm& norm, const Vec3& center, double radius) noexcept {
  const Vec3 f = center - ray.origin;
  const Vec3 w = cross(f, ray.direction);
  const double reach = radius * radius * norm.squared;
  const double scale = dot(f, f) * norm.squared;
  if (dot(w, w) - reach > 32 * kUnitRoundoff * (scale + reach)) return true;
  const double b = dot(f, ray.direction);
  return b < 0 && b * b > 64 * kUnitRoundoff * kUnitRoundoff * scale;
}

/// error:   l, R, b and c are off by a few u of themselves
inline Chord chord_of(const Ray& ray, const DirectionNorm& norm, const Vec3& center, double radius) noexcept {
  // Take the centre relative to the origin exactly.
  const ExactDifference f = exact_difference(center, ray.origin);
  const Vec3 w = exact_cross(f.hi, ray.direction) + cross(f.lo, ray.direction);

  // Compare the distance of the line with the radius, both times |d|.
  const double l = length(w);
  const double r = radius * norm.length;
  const double discriminant = (r - l) * (r + l);

  // Project the centre on the line.
  CompensatedSum b;
  b.add_product(f.hi.x, ray.direction.x);
  b.add_product(f.hi.y, ray.direction.y);
  b.add_product(f.hi.z, ray.direction.z);
  b.add_small(dot(f.lo, ray.direction));
  return {discriminant, b.value(), power_of_point(f, radius), std::sqrt(std::max(discriminant, 0.0)), w};
}

/// Which of the two crossings of a sphere.
enum class Root { near, far };

/// A crossing: its distance and the chord that gives the normal.
struct Crossing {
  double t;
  Root root;
  Chord chord;
};

/// Where a ray that starts outside of a sphere enters it, or nullopt. An origin that rounding has put a hair
/// inside counts as on the surface (t = 0); a tangent line hits.
/// units:   t in multiples of |d|
inline std::optional<Crossing> entry_into(const Ray& ray, const DirectionNorm& norm, const Vec3& center,
                                          double radius) noexcept {
  const Chord chord = chord_of(ray, norm, center, radius);
  if (chord.discriminant < 0 || !(chord.b > 0)) return std::nullopt;
  return Crossing{std::max(chord.c / (chord.b + chord.s), 0.0), Root::near, chord};
}

/// Where a ray that starts inside a sphere leaves it. There is always such a place: a line that rounding has put
/// outside leaves at its closest point.
/// units:   t in multiples of |d|
inline Crossing exit_from(const Ray& ray, const DirectionNorm& norm, const Vec3& center, double radius) noexcept {
  const Chord chord = chord_of(ray, norm, center, radius);
  const double t = chord.b >= 0 ? (chord.b + chord.s) / norm.squared : chord.c / (chord.b - chord.s);
  return {std::max(t, 0.0), Root::far, chord};
}

/// The outward unit normal at a crossing, from the line's perpendicular: no large distance enters it.
/// error:   about 7e-16 for any distance of the origin
inline Vec3 normal_at(const Crossing& crossing, const Vec3& direction) noexcept {
  const double along = crossing.root == Root::near ? -crossing.chord.s : crossing.chord.s;
  return normalized(along * direction - cross(direction, crossing.chord.w));
}

/// A ray that leaves a sphere's inner side crosses it again at t = -2 r (N.d) / (d.d), N outward at the origin.
inline double own_chord(const Ray& ray, const DirectionNorm& norm, double radius) noexcept {
  return std::max(-2 * radius * dot(ray.from_normal, ray.direction) / norm.squared, 0.0);
}

}  // namespace tessera::render
