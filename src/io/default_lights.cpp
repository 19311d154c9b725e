// SPDX-License-Identifier: BSD-3-Clause
#include "io/default_lights.h"

namespace tessera::io {

using render::Vec3;

std::vector<render::Light> default_lights(const Vec3& view_direction) {
  const Vec3 forward = normalized(view_direction);
  const bool looks_along_z = forward.x * forward.x + forward.y * forward.y < 1e-12;
  const Vec3 right = normalized(cross(forward, looks_along_z ? Vec3{0, 1, 0} : Vec3{0, 0, 1}));
  const Vec3 up = cross(right, forward);

  const auto light = [](const Vec3& travels, double intensity) {
    return render::Light{render::LightKind::directional, normalized(travels), {intensity, intensity, intensity}};
  };
  return {light(forward + 0.7 * right - 0.9 * up, 0.85), light(forward - 0.8 * right + 0.1 * up, 0.25)};
}

}  // namespace tessera::io
