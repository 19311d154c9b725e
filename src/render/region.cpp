// SPDX-License-Identifier: BSD-3-Clause
#include "render/region.h"

#include "render/decide.h"
#include "render/plane.h"

namespace tessera::render {

Region::Region(const Scene& scene, const Placement& placement, const Vec3& eye, const Vec3& direction)
    : enclosing_(placement.enclosing) {
  const auto enters = [&](SurfaceId sphere) { return side_of_plane(scene.sphere(sphere).center, eye, direction) > 0; };
  for (const SurfaceId surface : placement.touching) {
    if (scene.is_sphere(surface) && enters(surface)) enclosing_.push_back(surface);
  }
  std::sort(enclosing_.begin(), enclosing_.end());
  for (const SurfaceId id : enclosing_) {
    const auto coincides = [&](SurfaceId wall) { return coincide(scene.sphere(wall), scene.sphere(id)); };
    if (std::none_of(walls_.begin(), walls_.end(), coincides)) walls_.push_back(id);
  }

  for (const Plane& plane : scene.data().planes) {
    int side = render::side_of(eye, plane);
    if (side == 0) side = heading_of(direction, plane) < 0 ? -1 : 1;
    plane_sides_.push_back(static_cast<std::int8_t>(side));
  }
}

}  // namespace tessera::render
