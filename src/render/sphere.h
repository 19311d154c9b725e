// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/bounded.h"
#include "render/decide.h"
#include "render/exact.h"
#include "render/ray.h"
#include "render/scene_data.h"

// Where a line meets a sphere: the scalar specification that every faster kernel must match bit for bit.
//
// Hit or miss is read from Lagrange's identity (f.d)^2 - f^2 d^2 = -|f x d|^2 with f = C - O: compare the length
// l = |f x d| with R = r |d|. Neither is a difference of large numbers, so distance costs no accuracy; the
// textbook discriminant b^2 - 4ac loses all digits once the sphere is 1e8 radii away.
//
// Every quantity that something is decided on carries a bound on its rounding error; where the bound reaches over the
// decision, decide.h decides exactly. The bounds hold for scenes of unit scale, see scale.h.
namespace tessera::render {

/// A direction with what every sphere test needs of it.
struct DirectionNorm {
  double squared = 0;  ///< a = d.d
  double length = 0;   ///< sqrt(a)
};

/// requires: is_squarable(direction.direction)
inline DirectionNorm norm_of(const Vec3& direction) noexcept {
  const double a = dot(direction, direction);
  return {a, std::sqrt(a)};
}

/// -1 for a point inside a sphere, 0 on it, +1 outside; exact.
inline int side_of(const Vec3& point, const Vec3& center, double radius) noexcept {
  return bounded_power(exact_difference(center, point), radius).sign_or([&] {
    return side_of_sphere(point, center, radius);
  });
}

/// What first looks at spheres along one ray have in common.
struct LookBounds {
  double inverse_squared;  ///< 1 / d.d
  double inverse_length;
  double slack;        ///< more than p^2 - r^2 of any sphere is off by
  double foot_slack;   ///< more than the foot's t is off by
  double entry_error;  ///< what t of an entry is off by, where p^2 - r^2 < -slack
};

/// shapes:  reach = F >= |C - O| + r for every sphere that will be looked at
/// error:   the slack is 2^12 times what FirstLook needs: so the half chord of a sphere met is at least 2^-18 F, and
///          known to 2^-48 F^2 / 2^-18 F, without a division
inline LookBounds look_bounds(const DirectionNorm& norm, double reach) noexcept {
  const double inverse = 1 / norm.squared;
  const double inverse_length = inverse * norm.length;
  const double t = reach * inverse_length;
  return {inverse, inverse_length, 0x1p-36 * reach * reach, 0x1p-49 * t, 0x1p-29 * t};
}

/// The same for a second look at one sphere, for bounds on all spheres say nothing of one that is tiny beside the
/// scene.
///
/// error:   F is |C - O| + r; the half chord of a sphere met is at least 2^-24 F, and known to 2^-48 F^2 / 2^-24 F
inline LookBounds closer_bounds(const LookBounds& first, const Vec3& origin, const Vec3& center,
                                double radius) noexcept {
  const double reach = length(center - origin) + radius;
  const double t = reach * first.inverse_length;
  return {first.inverse_squared, first.inverse_length, 0x1p-48 * reach * reach, 0x1p-49 * t, 0x1p-23 * t};
}

/// A first look at a sphere from a ray outside of it, in plain double precision: by the foot of the perpendicular
/// from the centre. What it calls sure is sure; where it is not, the exact test below decides. It spares nearly all
/// spheres that test.
/// error:   with g = |C - O| + r <= F: the foot's distance is off by 10u g (a u of f, three of f.d, five of its
///          division by d.d), the perpendicular p by 13u g, and p^2 - r^2 by 26u g^2 + 5u g^2 <= 2^-48 g^2. A half
///          chord s is off by |sqrt x - sqrt y| <= |x - y| / sqrt x, so by 2^-48 F^2 / s >= 32u g; twice that
///          outweighs the error of the foot and the roundings
/// source:  the formulation of Haines, Günther, Akenine-Möller, Ray Tracing Gems (2019), ch. 7
class FirstLook {
 public:
  FirstLook(const Ray& ray, const LookBounds& bounds, const Vec3& center, double radius) noexcept {
    const Vec3 f = center - ray.origin;
    foot_ = dot(f, ray.direction) * bounds.inverse_squared;
    const Vec3 p = f - foot_ * ray.direction;
    excess_ = dot(p, p) - radius * radius;
  }

  /// The line passes the sphere.
  bool surely_passes(const LookBounds& bounds) const noexcept { return excess_ > bounds.slack; }
  /// The sphere lies behind the ray's origin.
  bool surely_lies_behind(const LookBounds& bounds) const noexcept { return foot_ < -bounds.foot_slack; }
  /// The ray enters the sphere.
  bool surely_meets(const LookBounds& bounds) const noexcept {
    return excess_ < -bounds.slack && foot_ > bounds.foot_slack;
  }
  /// The point of the line nearest to the centre comes before `end` times the direction.
  bool is_surely_before(double end, const LookBounds& bounds) const noexcept { return foot_ < end - bounds.foot_slack; }

  /// The distance to a sphere that is surely met; below 0 for an origin that rounding has put inside.
  /// units:   t in multiples of |d|
  Bounded entry(const LookBounds& bounds) const noexcept {
    return {foot_ - std::sqrt(-excess_) * bounds.inverse_length, bounds.entry_error};
  }

 private:
  double foot_;    ///< t of the point of the line nearest to the centre
  double excess_;  ///< p^2 - r^2
};

/// How far a line passes from a sphere's centre, times |d|.
struct Offset {
  ExactDifference f;    ///< C - O
  Vec3 w;               ///< f x d
  double l;             ///< |w|
  double r;             ///< the radius times |d|
  double discriminant;  ///< (r - l)(r + l): < 0 where the line misses, 0 where it touches
};

/// error:   w is off by 4u l + 16u^2 |f||d|, so l by 7u l and twice the rest, r by 4u r
inline Offset offset_of(const Ray& ray, const DirectionNorm& norm, const Vec3& center, double radius) noexcept {
  // Take the centre relative to the origin exactly.
  const ExactDifference f = exact_difference(center, ray.origin);
  const Vec3 w = exact_cross(f.hi, ray.direction) + cross(f.lo, ray.direction);

  // Compare the distance of the line with the radius, both times |d|.
  const double l = length(w);
  const double r = radius * norm.length;
  return {f, w, l, r, (r - l) * (r + l)};
}

/// How a line passes a sphere; both roots and both normals follow from it.
struct Passage {
  ExactDifference f;     ///< C - O
  Vec3 w;                ///< f x d
  Bounded discriminant;  ///< < 0 where the line misses, 0 where it touches
  Bounded b;             ///< f.d
};

/// error:   of the discriminant, from those of l and r with |f||d| <= |b| + l
inline Passage passage_of(const Ray& ray, const DirectionNorm& norm, const Vec3& center, double radius) noexcept {
  const auto [f, w, l, r, discriminant] = offset_of(ray, norm, center, radius);
  const Bounded b = bounded_dot(f, ray.direction);
  const double off = 10 * kUnitRoundoff * (r + l) + 32 * kUnitRoundoff * kUnitRoundoff * std::abs(b.value);
  return {f, w, {discriminant, 2 * off * (r + l + off)}, b};
}

/// Whether the line of `ray` meets the sphere or touches it; exact.
inline bool line_meets(const Passage& passage, const Ray& ray, const Vec3& center, double radius) noexcept {
  return passage.discriminant.sign_or([&] { return line_meets_sphere(ray.origin, ray.direction, center, radius); }) >=
         0;
}

/// Whether the sphere's centre lies ahead of the origin; exact.
inline bool lies_ahead(const Passage& passage, const Ray& ray, const Vec3& center) noexcept {
  return passage.b.sign_or([&] { return side_of_plane(center, ray.origin, ray.direction); }) > 0;
}

/// Whether the point of the line nearest to the centre comes before origin + end direction; exact.
/// shapes:  end is a power of two
inline bool nearest_point_comes_before(double end, const Passage& passage, const Ray& ray, const DirectionNorm& norm,
                                       const Vec3& center) noexcept {
  const double reach = end * norm.squared;
  const Bounded gap{passage.b.value - reach, passage.b.error + 8 * kUnitRoundoff * (reach + std::abs(passage.b.value))};
  return gap.sign_or([&] { return nearest_point_against_end(ray.origin, ray.direction, end, center); }) < 0;
}

/// Half the chord times |d|, 0 for a line that touches or misses.
inline Bounded half_chord(const Passage& passage) noexcept {
  const auto [discriminant, error] = passage.discriminant;
  const double s = std::sqrt(std::max(discriminant, 0.0));
  // |sqrt x - sqrt y| is at most |x - y| / sqrt x, and at most sqrt |x - y|.
  return {s, discriminant > error ? error / s : 2 * std::sqrt(error)};
}

/// Which of the two crossings of a sphere.
enum class Root { near, far };

/// A crossing: its distance and what gives the normal.
struct Crossing {
  Bounded t;
  Root root;
  double s;  ///< half the chord times |d|
  Vec3 w;    ///< f x d
};

/// Where a ray that starts outside of a sphere enters it, or nullopt; that is decided exactly. An origin that rounding
/// has put a hair inside counts as on the surface (t = 0); a tangent line hits.
/// units:   t in multiples of |d|
inline std::optional<Crossing> entry_into(const Ray& ray, const DirectionNorm& norm, const Vec3& center,
                                          double radius) noexcept {
  const Passage passage = passage_of(ray, norm, center, radius);
  if (!line_meets(passage, ray, center, radius) || !lies_ahead(passage, ray, center)) return std::nullopt;
  const Bounded s = half_chord(passage);
  const Bounded t =
      bounded_quotient(bounded_power(passage.f, radius), {passage.b.value + s.value, passage.b.error + s.error});
  return Crossing{not_negative(t), Root::near, s.value, passage.w};
}

/// Where a ray that starts inside a sphere leaves it. There is always such a place: a line that rounding has put
/// outside leaves at its closest point.
/// units:   t in multiples of |d|
inline Crossing exit_from(const Ray& ray, const DirectionNorm& norm, const Vec3& center, double radius) noexcept {
  const Passage passage = passage_of(ray, norm, center, radius);
  const Bounded s = half_chord(passage);
  const double b = passage.b.value;
  const double off = passage.b.error + s.error;
  const auto far_end = [&](const Bounded& t) { return Crossing{not_negative(t), Root::far, s.value, passage.w}; };
  if (b >= 0) {
    const double sum = b + s.value;
    return far_end(
        bounded_quotient({sum, off + kUnitRoundoff * sum}, {norm.squared, 4 * kUnitRoundoff * norm.squared}));
  }
  const Bounded c = bounded_power(passage.f, radius);
  return far_end(bounded_quotient({-c.value, c.error}, {s.value - b, off}));
}

/// The outward unit normal at a crossing, from the line's perpendicular: no large distance enters it.
/// error:   about 7e-16 for any distance of the origin
inline Vec3 normal_at(Root root, double s, const Vec3& w, const Vec3& direction) noexcept {
  const double along = root == Root::near ? -s : s;
  return normalized(along * direction - cross(direction, w));
}
inline Vec3 normal_at(const Crossing& crossing, const Vec3& direction) noexcept {
  return normal_at(crossing.root, crossing.s, crossing.w, direction);
}

/// The normal where a ray enters a sphere that it surely does: that of entry_into's crossing, without its distance.
inline Vec3 sure_entry_normal(const Ray& ray, const DirectionNorm& norm, const Vec3& center, double radius) noexcept {
  const Offset offset = offset_of(ray, norm, center, radius);
  return normal_at(Root::near, std::sqrt(std::max(offset.discriminant, 0.0)), offset.w, ray.direction);
}

/// A ray that leaves a sphere's inner side crosses it again at t = -2 r (N.d) / (d.d), N outward at the origin.
inline Bounded own_chord(const Ray& ray, const DirectionNorm& norm, double radius) noexcept {
  const double t = -2 * radius * dot(ray.from_normal, ray.direction) / norm.squared;
  return not_negative({t, 16 * kUnitRoundoff * (std::abs(t) + radius / norm.length)});
}

}  // namespace tessera::render
