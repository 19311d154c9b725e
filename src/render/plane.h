// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/scene_data.h"

namespace tessera::render {

/// The material at a point of a plane: its own, or on the odd cells of the board the checker's.
/// The board's axes: u = e_i x N normalised for the axis i where |N_i| is smallest (the first of equals), v = N x u.
MaterialIndex material_at(const Plane& plane, const Vec3& point) noexcept;

}  // namespace tessera::render
