// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "render/scene_data.h"

// Light for scenes from formats that have no lights.
namespace tessera::io {

/// A key light from above the eye's left and a weak fill from its right, both directional.
/// shapes:  view_direction, from the eye into the scene, has any length > 0; up is z
std::vector<render::Light> default_lights(const render::Vec3& view_direction);

}  // namespace tessera::io
