// SPDX-License-Identifier: BSD-3-Clause
#include "render/region.h"

#include <tuple>

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
  // Of coincident spheres the first is the wall: put them side by side, for there may be very many.
  const auto place_of = [&](SurfaceId id) {
    const Sphere& sphere = scene.sphere(id);
    return std::tuple(sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius);
  };
  walls_ = enclosing_;
  std::sort(walls_.begin(), walls_.end(),
            [&](auto a, auto b) { return std::tuple(place_of(a), a) < std::tuple(place_of(b), b); });
  walls_.erase(std::unique(walls_.begin(), walls_.end(), [&](auto a, auto b) { return scene.are_coincident(a, b); }),
               walls_.end());
  std::sort(walls_.begin(), walls_.end());

  for (const Plane& plane : scene.data().planes) {
    int side = render::side_of(eye, plane);
    if (side == 0) side = heading_of(direction, plane) < 0 ? -1 : 1;
    plane_sides_.push_back(static_cast<std::int8_t>(side));
  }
}

}  // namespace tessera::render
