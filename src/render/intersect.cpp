// SPDX-License-Identifier: BSD-3-Clause
#include "render/intersect.h"

#include <algorithm>
#include <limits>

#include "render/order.h"
#include "render/plane.h"
#include "render/sphere.h"

namespace tessera::render {
namespace {

/// Where the ray, inside of `sphere`, leaves it. `ray.from` being that sphere, its own chord says so.
Candidate exit_candidate(const Ray& ray, const DirectionNorm& norm, const Sphere& sphere, SurfaceId id) noexcept {
  if (ray.from == id) return {id, Meeting::own_exit, own_chord(ray, norm, sphere.radius)};
  return {id, Meeting::exit, exit_from(ray, norm, sphere.center, sphere.radius).t};
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

/// `ray` with a direction that can be squared: its own where it can, else 2^k times it.
struct SquarableRay {
  Ray ray;
  int k = 0;
  DirectionNorm norm;

  explicit SquarableRay(const Ray& given) noexcept : ray(given), norm(norm_of(given.direction)) {
    if (is_squarable(norm.squared)) return;
    ray.direction = rescaled(given.direction, k);
    norm = norm_of(ray.direction);
  }
};

}  // namespace

std::optional<Hit> nearest_hit(const Scene& scene, const Ray& given, const Region& region) noexcept {
  const auto [ray, k, norm] = SquarableRay(given);
  Candidate best;
  double latest = std::numeric_limits<double>::infinity();  // no hit after this can be the first
  const auto take = [&](const Candidate& candidate) {
    if (best.surface != SurfaceId::none && !comes_first(scene, ray, candidate, best)) return false;
    best = candidate;
    latest = candidate.latest();
    return true;
  };

  // Spheres around the path: the far side is the hit.
  for (const SurfaceId id : region.walls()) take(exit_candidate(ray, norm, scene.sphere(id), id));
  // All other spheres: the near side. A convex body that was just left cannot be met again.
  Crossing entry{};
  scene.visit_along(ray, latest, [&](const LeafSphere& sphere) {
    const FirstLook look(ray, norm, sphere.center, sphere.radius);
    if (look.surely_misses() || look.surely_enters_after(latest, norm, sphere.radius)) return false;
    if (sphere.id == ray.from || region.is_inside(sphere.id)) return false;
    const auto crossing = entry_into(ray, norm, sphere.center, sphere.radius);
    if (crossing && take({sphere.id, Meeting::entry, crossing->t})) entry = *crossing;
    return false;
  });
  for (std::size_t i = 0; i != scene.data().planes.size(); ++i) {
    const SurfaceId id = scene.plane_id(i);
    if (id == ray.from) continue;
    if (const auto t = distance_to(scene.data().planes[i], ray, region.side_of(i))) {
      take({id, Meeting::plane, *t});
    }
  }

  if (best.surface == SurfaceId::none) return std::nullopt;
  const double t = k == 0 ? best.t.value : std::ldexp(best.t.value, k);
  if (best.meeting == Meeting::plane) {
    return Hit{best.surface, t, ray.origin + best.t.value * ray.direction,
               normalized(scene.plane(best.surface).normal)};
  }
  const Sphere& sphere = scene.sphere(best.surface);
  const Vec3 normal =
      best.meeting == Meeting::entry ? normal_at(entry, ray.direction) : exit_normal(ray, norm, sphere, best.surface);
  return sphere_hit(sphere, best.surface, t, normal);
}

bool is_occluded(const Scene& scene, const Ray& given, std::size_t light_index, const Region& region) noexcept {
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

  // All others block where the line meets them between its ends: neither end is inside, so it is enough that the
  // point nearest to the centre lies between.
  const Light& light = scene.data().lights[light_index];
  const bool is_point = light.kind == LightKind::point;
  const auto [to_light, k, norm] = SquarableRay(given);
  const double end = is_point ? std::ldexp(1.0, -k) : std::numeric_limits<double>::infinity();
  bool blocked = false;
  scene.visit_along(to_light, end, [&](const LeafSphere& sphere) {
    const FirstLook look(to_light, norm, sphere.center, sphere.radius);
    if (look.surely_misses()) return false;
    if (sphere.id == to_light.from || region.is_inside(sphere.id)) return false;
    // The light is on this sphere, on the side that the ray comes from: that is the end point, which is open.
    const bool touches_light = holds(placement.touching, sphere.id);
    if (touches_light && side_of_plane(light.vector, sphere.center, to_light.direction) <= 0) return false;
    if (!touches_light && look.surely_meets_before(end, norm)) return blocked = true;
    const Passage passage = passage_of(to_light, norm, sphere.center, sphere.radius);
    const bool has_end = is_point && !touches_light;
    blocked = line_meets(passage, to_light, sphere.center, sphere.radius) &&
              lies_ahead(passage, to_light, sphere.center) &&
              (!has_end || nearest_point_comes_before(end, passage, to_light, norm, sphere.center));
    return blocked;
  });
  return blocked;
}

}  // namespace tessera::render
