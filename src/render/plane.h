// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "render/bounded.h"
#include "render/ray.h"
#include "render/scene_data.h"

namespace tessera::render {

/// -1 for a point behind a plane, 0 on it, +1 before it, as its normal points; exact.
int side_of(const Vec3& point, const Plane& plane) noexcept;

/// The sign of normal.direction: -1 for a direction that goes against the normal; exact.
int heading_of(const Vec3& direction, const Plane& plane) noexcept;

/// Distance to a plane that the ray runs towards, or nullopt; that is decided exactly. The origin is on side `side` of
/// the plane, whatever rounding says.
/// units:   t in multiples of |direction|
std::optional<Bounded> distance_to(const Plane& plane, const Ray& ray, int side) noexcept;

/// The material at a point of a plane: its own, or on the odd cells of the board the checker's.
/// The board's axes: u = e_i x N normalised for the axis i where |N_i| is smallest (the first of equals), v = N x u.
MaterialIndex material_at(const Plane& plane, const Vec3& point) noexcept;

}  // namespace tessera::render
