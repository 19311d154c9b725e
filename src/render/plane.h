// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "render/bounded.h"
#include "render/decide.h"
#include "render/ray.h"
#include "render/scene_data.h"

namespace tessera::render {

/// a.b of rounded vectors where little cancels, which is nearly always; nothing where much does.
/// error:   a's components are off by at most u of themselves
inline std::optional<Bounded> plain_dot(const Vec3& a, const Vec3& b) noexcept {
  const Vec3 products{a.x * b.x, a.y * b.y, a.z * b.z};
  const double value = products.x + products.y + products.z;
  const double terms = std::abs(products.x) + std::abs(products.y) + std::abs(products.z);
  if (!(terms <= 4 * std::abs(value))) return std::nullopt;
  return Bounded{value, 8 * kUnitRoundoff * terms};
}

/// (point - plane.point).normal
inline Bounded height_over(const Plane& plane, const Vec3& point) noexcept {
  if (const auto plain = plain_dot(point - plane.point, plane.normal)) return *plain;
  return bounded_dot(exact_difference(point, plane.point), plane.normal);
}

/// direction.normal
inline Bounded approach(const Vec3& direction, const Plane& plane) noexcept {
  if (const auto plain = plain_dot(direction, plane.normal)) return *plain;
  return bounded_dot({direction, {}}, plane.normal);
}

/// -1 for a point behind a plane, 0 on it, +1 before it, as its normal points; exact.
inline int side_of(const Vec3& point, const Plane& plane) noexcept {
  return height_over(plane, point).sign_or([&] { return side_of_plane(point, plane.point, plane.normal); });
}

/// The sign of normal.direction: -1 for a direction that goes against the normal; exact.
inline int heading_of(const Vec3& direction, const Plane& plane) noexcept {
  return approach(direction, plane).sign_or([&] { return sign_of_dot(plane.normal, direction); });
}

/// Distance to a plane that the ray runs towards, or nullopt; that is decided exactly. The origin is on side `side` of
/// the plane, whatever rounding says. Nullopt too for a plane that is surely met after `latest`.
/// units:   t in multiples of |direction|
inline std::optional<Bounded> distance_to(const Plane& plane, const Ray& ray, int side,
                                          double latest = std::numeric_limits<double>::infinity()) noexcept {
  const Bounded speed = approach(ray.direction, plane);
  if (speed.sign_or([&] { return sign_of_dot(plane.normal, ray.direction); }) != -side) return std::nullopt;
  const Bounded way = height_over(plane, ray.origin);
  if (side * way.value - way.error > latest * (std::abs(speed.value) + speed.error)) return std::nullopt;
  return not_negative(bounded_quotient({side * way.value, way.error}, {-side * speed.value, speed.error}));
}

/// The value of distance_to for a plane that the ray surely runs towards.
inline double sure_distance_to(const Plane& plane, const Ray& ray, int side) noexcept {
  const double speed = approach(ray.direction, plane).value;
  const double way = height_over(plane, ray.origin).value;
  return std::max(side * way / (-side * speed), 0.0);
}

/// What first looks at planes along one ray, or at one plane along all rays, have in common.
struct PlaneLookRay {
  double length;  ///< >= |d|
  double reach;   ///< >= |O|
};
struct PlaneLookBounds {
  double length;  ///< >= |n|
  double reach;   ///< >= |P|
};

/// A first look at a plane, in plain double precision. What it calls sure is sure; where it is not, distance_to
/// decides.
///
/// error:   the speed d.n is off by 3u |d||n|, the height (O - P).n by 4u (|O| + |P|) |n|; both are counted as 8u. At a
///          speed of more than 2^10 times its error, t = height / speed is off by the errors of both, divided by it
class PlaneLook {
 public:
  PlaneLook(const Ray& ray, const PlaneLookRay& of_ray, const Plane& plane, const PlaneLookBounds& of_plane,
            int side) noexcept
      : ray_(ray), plane_(plane), side_(side) {
    const double unit = 8 * kUnitRoundoff * of_plane.length;
    speed_ = -side_ * dot(ray.direction, plane.normal);
    speed_error_ = unit * of_ray.length;
    // Products that vanish lose less than the smallest normal number.
    height_error_ = unit * (of_ray.reach + of_plane.reach) + std::numeric_limits<double>::min();
  }

  /// The ray does not run towards the plane.
  bool surely_recedes() const noexcept { return speed_ < -speed_error_; }
  /// The ray runs towards the plane, and `distance` says how far.
  bool surely_approaches() const noexcept { return speed_ > 0x1p10 * speed_error_; }

  /// The distance to a plane that is surely approached; below 0 for an origin that rounding has put behind it.
  /// units:   t in multiples of |d|
  Bounded distance() const noexcept {
    const double inverse = 1 / speed_;
    const double t = side_ * dot(ray_.origin - plane_.point, plane_.normal) * inverse;
    return {t, 2 * inverse * (height_error_ + std::abs(t) * speed_error_)};
  }

 private:
  const Ray& ray_;
  const Plane& plane_;
  double side_;
  double speed_;
  double speed_error_;
  double height_error_;
};

/// The board on a plane: its unit axes, and the unit normal.
struct CheckerAxes {
  Vec3 u;  ///< e_i x N normalised for the axis i where |N_i| is smallest, the first of equals
  Vec3 v;  ///< N x u

  explicit CheckerAxes(const Plane& plane) noexcept;
};

/// The cell at a point of a board: floor(offset.u / size) + floor(offset.v / size), even or odd.
/// requires: plane.checker
Cell board_cell_at(const Plane& plane, const Vec3& point) noexcept;

/// The cell at a point of any plane.
inline Cell cell_at(const Plane& plane, const Vec3& point) noexcept {
  return plane.checker ? board_cell_at(plane, point) : Cell::even;
}

/// The material of a cell: the plane's own, or on the odd ones of a board the checker's.
inline MaterialIndex material_of(const Plane& plane, Cell cell) noexcept {
  return cell == Cell::odd ? plane.checker->material : plane.material;
}

}  // namespace tessera::render
