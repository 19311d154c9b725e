// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/vec3.h"

// Exact decisions about points, lines, spheres and planes given in doubles: the slow stages, asked where the filters
// of sphere.h and plane.h cannot tell.
namespace tessera::render {

/// Sign of |center - point|^2 - radius^2: -1 for a point inside the sphere, 0 on it, +1 outside.
int side_of_sphere(const Vec3& point, const Vec3& center, double radius);

/// Sign of (point - base).normal: -1 behind the plane, 0 on it, +1 before it.
int side_of_plane(const Vec3& point, const Vec3& base, const Vec3& normal);

/// Sign of radius^2 d.d - |(center - origin) x d|^2: -1 where the line misses the sphere, 0 where it touches.
int line_meets_sphere(const Vec3& origin, const Vec3& direction, const Vec3& center, double radius);

/// Sign of a.b.
int sign_of_dot(const Vec3& a, const Vec3& b);

/// Sign of (center - origin).d - end d.d: -1 where the line's point nearest to the centre comes before origin + end d.
int nearest_point_against_end(const Vec3& origin, const Vec3& direction, double end, const Vec3& center);

}  // namespace tessera::render
