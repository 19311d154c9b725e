// SPDX-License-Identifier: BSD-3-Clause
#include "render/intersect.h"

#include <algorithm>
#include <limits>

#include "render/sphere.h"

namespace tessera::render {
namespace {

/// Distance to a plane that the ray runs towards, or nullopt. The origin is before the plane on the region's side,
/// whatever rounding says.
std::optional<double> distance_to_plane(const Ray& ray, const Plane& plane, int side) noexcept {
  const double approach = dot(plane.normal, ray.direction);
  if (!(approach * side < 0)) return std::nullopt;
  return std::max(dot(plane.point - ray.origin, plane.normal) / approach, 0.0);
}

/// Where the ray, inside of `sphere`, leaves it. `ray.from` being that sphere, its own chord says so exactly.
double distance_to_exit(const Ray& ray, const DirectionNorm& norm, const Sphere& sphere, SurfaceId id) noexcept {
  return ray.from == id ? own_chord(ray, norm, sphere.radius) : exit_from(ray, norm, sphere.center, sphere.radius).t;
}

Vec3 exit_normal(const Ray& ray, const DirectionNorm& norm, const Sphere& sphere, SurfaceId id) noexcept {
  if (ray.from != id) return normal_at(exit_from(ray, norm, sphere.center, sphere.radius), ray.direction);
  // Both ends of a chord lie symmetric to the plane through the centre across it.
  const double along = 2 * dot(ray.from_normal, ray.direction) / norm.squared;
  return normalized(ray.from_normal - along * ray.direction);
}

Hit sphere_hit(const Sphere& sphere, SurfaceId id, double t, const Vec3& normal) noexcept {
  return {id, t, sphere.center + sphere.radius * normal, normal};
}

}  // namespace

std::optional<Hit> nearest_hit(const Scene& scene, const Ray& ray, const Region& region) noexcept {
  const DirectionNorm norm = norm_of(ray.direction);
  double best = std::numeric_limits<double>::infinity();
  SurfaceId winner = SurfaceId::none;
  const auto take = [&](double t, SurfaceId id) {
    if (t < best || (t == best && id < winner)) {
      best = t;
      winner = id;
    }
  };

  // Spheres around the path: the far side is the hit.
  for (const SurfaceId id : region.walls()) take(distance_to_exit(ray, norm, scene.sphere(id), id), id);
  // All other spheres: the near side. A convex body that was just left cannot be met again.
  Crossing entry{};
  scene.visit_along(ray, best, [&](const LeafSphere& sphere) {
    if (surely_misses(ray, norm, sphere.center, sphere.radius)) return false;
    if (sphere.id == ray.from || region.is_inside(sphere.id)) return false;
    const auto crossing = entry_into(ray, norm, sphere.center, sphere.radius);
    if (!crossing) return false;
    take(crossing->t, sphere.id);
    if (winner == sphere.id) entry = *crossing;
    return false;
  });
  for (std::size_t i = 0; i != scene.data().planes.size(); ++i) {
    const SurfaceId id = scene.plane_id(i);
    if (id == ray.from) continue;
    if (const auto t = distance_to_plane(ray, scene.data().planes[i], region.side_of(i))) take(*t, id);
  }

  if (winner == SurfaceId::none) return std::nullopt;
  if (!scene.is_sphere(winner)) {
    return Hit{winner, best, ray.origin + best * ray.direction, normalized(scene.plane(winner).normal)};
  }
  const Sphere& sphere = scene.sphere(winner);
  const Vec3 normal =
      region.is_inside(winner) ? exit_normal(ray, norm, sphere, winner) : normal_at(entry, ray.direction);
  return sphere_hit(sphere, winner, best, normal);
}

bool is_occluded(const Scene& scene, const Ray& to_light, std::size_t light_index, const Region& region) noexcept {
  // A plane blocks exactly if the light is on its other side.
  for (std::size_t i = 0; i != scene.data().planes.size(); ++i) {
    if (scene.light_side(light_index, i) == -region.side_of(i)) return true;
  }
  // A sphere around the light blocks exactly if the path is outside of it, and the other way round.
  const Placement& placement = scene.light_placement(light_index);
  for (const SurfaceId id : placement.enclosing) {
    if (!region.is_inside(id)) return true;
  }
  const auto holds = [](const std::vector<SurfaceId>& ids, SurfaceId id) {
    return !ids.empty() && std::binary_search(ids.begin(), ids.end(), id);
  };
  for (const SurfaceId id : region.walls()) {
    if (!holds(placement.enclosing, id) && !holds(placement.touching, id)) return true;
  }

  // All others block where they are entered before the light.
  const Light& light = scene.data().lights[light_index];
  const double end = light.kind == LightKind::point ? 1 : std::numeric_limits<double>::infinity();
  const DirectionNorm norm = norm_of(to_light.direction);
  bool blocked = false;
  scene.visit_along(to_light, end, [&](const LeafSphere& sphere) {
    if (surely_misses(to_light, norm, sphere.center, sphere.radius)) return false;
    if (sphere.id == to_light.from || region.is_inside(sphere.id)) return false;
    // The light is on this sphere, on the side that the ray comes from: that is the end point, which is open.
    if (holds(placement.touching, sphere.id) && dot(light.vector - sphere.center, to_light.direction) <= 0)
      return false;
    const auto crossing = entry_into(to_light, norm, sphere.center, sphere.radius);
    blocked = crossing && crossing->t < end;
    return blocked;
  });
  return blocked;
}

}  // namespace tessera::render
