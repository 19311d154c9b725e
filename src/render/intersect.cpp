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

Hit plane_hit(const Scene& scene, const Ray& ray, SurfaceId id, double t) noexcept {
  return {id, t, ray.origin + t * ray.direction, scene.unit_normal(id)};
}

Hit sphere_hit(const Sphere& sphere, SurfaceId id, double t, const Vec3& normal) noexcept {
  return {id, t, sphere.center + sphere.radius * normal, normal};
}

/// `ray` in another direction.
Ray along(Ray ray, const Vec3& direction) noexcept {
  ray.direction = direction;
  return ray;
}

bool holds(const std::vector<SurfaceId>& ids, SurfaceId id) noexcept {
  return !ids.empty() && std::binary_search(ids.begin(), ids.end(), id);
}

/// Whether a sphere that holds neither end of the path to a light stands in it: where the line meets such a sphere
/// between its ends. As neither end is inside, it is enough that the point nearest to the centre lies between.
/// shapes:  the light is at to_light.origin + end to_light.direction, or infinitely far
bool is_blocked(const Scene& scene, const Ray& to_light, double end, std::size_t light_index,
                const Region& region) noexcept {
  const Light& light = scene.data().lights[light_index];
  const bool is_point = light.kind == LightKind::point;
  const Placement& placement = scene.light_placement(light_index);
  std::optional<LookBounds> any;  // most rays to a light come near no sphere
  bool blocked = false;
  scene.visit_along(to_light, end, [&](const LeafSphere& sphere) {
    if (!any) any = look_bounds(norm_of(to_light.direction), scene.reach_from(to_light.origin));
    const LookBounds& bounds = *any;
    const FirstLook look(to_light, bounds, sphere.center, sphere.radius);
    if (look.surely_passes(bounds)) return false;
    if (sphere.id == to_light.from || region.is_inside(sphere.id)) return false;
    // The light is on this sphere, on the side that the ray comes from: that is the end point, which is open.
    const bool touches_light = holds(placement.touching, sphere.id);
    if (touches_light && side_of_plane(light.vector, sphere.center, to_light.direction) <= 0) return false;
    if (!touches_light && look.surely_meets(bounds) && look.is_surely_before(end, bounds)) return blocked = true;
    if (look.surely_lies_behind(bounds)) return false;
    const LookBounds closer = closer_bounds(bounds, to_light.origin, sphere.center, sphere.radius);
    const FirstLook second(to_light, closer, sphere.center, sphere.radius);
    if (second.surely_passes(closer) || second.surely_lies_behind(closer)) return false;
    if (!touches_light && second.surely_meets(closer) && second.is_surely_before(end, closer)) return blocked = true;
    if (scene.are_coincident(sphere.id, to_light.from)) return false;
    const DirectionNorm norm = norm_of(to_light.direction);
    const Passage passage = passage_of(to_light, norm, sphere.center, sphere.radius);
    const bool has_end = is_point && !touches_light;
    blocked = line_meets(passage, to_light, sphere.center, sphere.radius) &&
              lies_ahead(passage, to_light, sphere.center) &&
              (!has_end || nearest_point_comes_before(end, passage, to_light, norm, sphere.center));
    return blocked;
  });
  return blocked;
}

}  // namespace

std::optional<Hit> nearest_hit(const Scene& scene, const Ray& ray, const Region& region) noexcept {
  if (!is_squarable(dot(ray.direction, ray.direction))) {
    int k = 0;
    auto hit = nearest_hit(scene, along(ray, rescaled(ray.direction, k)), region);
    if (hit) hit->t = std::ldexp(hit->t, k);
    return hit;
  }
  const DirectionNorm norm = norm_of(ray.direction);
  Candidate best;
  double latest = std::numeric_limits<double>::infinity();  // no hit after this can be the first
  // Member by member: copied as a whole, a candidate waits for its parts to reach memory.
  const auto take = [&](const Candidate& candidate) {
    if (best.surface != SurfaceId::none && !comes_first(scene, ray, candidate, best)) return false;
    best.surface = candidate.surface;
    best.meeting = candidate.meeting;
    best.t.value = candidate.t.value;
    best.t.error = candidate.t.error;
    latest = std::min(latest, candidate.latest());
    return true;
  };

  // Spheres around the path: the far side is the hit.
  for (const SurfaceId id : region.walls()) take(exit_candidate(ray, norm, scene.sphere(id), id));
  // All other spheres: the near side. A convex body that was just left cannot be met again, nor one that coincides.
  Crossing entry{};
  const auto settle = [&](SurfaceId id) {
    if (!scene.is_sphere(id)) {
      const int side = region.side_of(index_of(id) - scene.sphere_count());
      if (const auto t = distance_to(scene.plane(id), ray, side, latest)) take({id, Meeting::plane, *t});
      return;
    }
    if (scene.are_coincident(id, ray.from)) return;
    const Sphere& sphere = scene.sphere(id);
    const auto crossing = entry_into(ray, norm, sphere.center, sphere.radius);
    if (crossing && take({id, Meeting::entry, crossing->t})) entry = *crossing;
  };
  // First looks usually leave one favourite, met before all others; only what they cannot tell apart is settled.
  SurfaceId favourite = SurfaceId::none;
  double favourite_earliest = 0;
  const auto prefer = [&](SurfaceId id, const Bounded& t) {
    if (t.value - t.error > latest) return;
    const double t_latest = std::max(t.value + t.error, 0.0);
    if (favourite != SurfaceId::none && t_latest >= favourite_earliest) {
      settle(favourite);
      settle(id);
      favourite = SurfaceId::none;
      return;
    }
    favourite = id;
    favourite_earliest = t.value - t.error;
    latest = std::min(latest, t_latest);
  };
  // Planes first: what lies behind one need not be searched for spheres.
  const PlaneLookRay plane_look{norm.length, sum_of_sizes(ray.origin)};
  for (const std::size_t i : scene.visible_planes()) {
    const SurfaceId id = scene.plane_id(i);
    if (id == ray.from) continue;
    const PlaneLook look(ray, plane_look, scene.data().planes[i], scene.plane_look(i), region.side_of(i));
    if (look.surely_approaches()) {
      prefer(id, look.distance());
    } else if (!look.surely_recedes()) {
      settle(id);
    }
  }
  const auto consider = [&](const LookBounds& bounds, const LeafSphere& sphere, auto&& where_unsure) {
    const FirstLook look(ray, bounds, sphere.center, sphere.radius);
    if (look.surely_passes(bounds) || sphere.id == ray.from || region.is_inside(sphere.id)) return;
    if (look.surely_meets(bounds)) return prefer(sphere.id, look.entry(bounds));
    if (!look.surely_lies_behind(bounds)) where_unsure();
  };
  std::optional<LookBounds> any;
  scene.visit_along(ray, latest, [&](const LeafSphere& sphere) {
    if (!any) any = look_bounds(norm, scene.reach_from(ray.origin));
    const LookBounds& first_bounds = *any;
    consider(first_bounds, sphere, [&] {
      const LookBounds closer = closer_bounds(first_bounds, ray.origin, sphere.center, sphere.radius);
      consider(closer, sphere, [&] { settle(sphere.id); });
    });
    return false;
  });
  if (favourite != SurfaceId::none) {
    // Nothing else is left: where the plane is met is all that is asked.
    if (best.surface == SurfaceId::none && !scene.is_sphere(favourite)) {
      const int side = region.side_of(index_of(favourite) - scene.sphere_count());
      return plane_hit(scene, ray, favourite, sure_distance_to(scene.plane(favourite), ray, side));
    }
    settle(favourite);
  }

  if (best.surface == SurfaceId::none) return std::nullopt;
  const double t = best.t.value;
  if (best.meeting == Meeting::plane) return plane_hit(scene, ray, best.surface, t);
  const Sphere& sphere = scene.sphere(best.surface);
  const Vec3 normal =
      best.meeting == Meeting::entry ? normal_at(entry, ray.direction) : exit_normal(ray, norm, sphere, best.surface);
  return sphere_hit(sphere, best.surface, t, normal);
}

bool is_shut_off(const Scene& scene, std::size_t light_index, const Region& region) noexcept {
  // A plane blocks exactly if the light is on its other side.
  const std::size_t plane_count = scene.data().planes.size();
  for (std::size_t i = 0; i != plane_count; ++i) {
    if (scene.light_side(light_index, i) == -region.side_of(i)) return true;
  }
  // A sphere around the light blocks exactly if the path is outside of it, and the other way round.
  const Placement& placement = scene.light_placement(light_index);
  for (const SurfaceId id : placement.enclosing) {
    if (!region.is_inside(id)) return true;
  }
  for (const SurfaceId id : region.walls()) {
    if (!holds(placement.enclosing, id) && !holds(placement.touching, id)) return true;
  }
  return false;
}

bool is_occluded(const Scene& scene, const Ray& to_light, std::size_t light_index, const Region& region) noexcept {
  if (is_shut_off(scene, light_index, region)) return true;

  const Light& light = scene.data().lights[light_index];
  const double end = light.kind == LightKind::point ? 1 : std::numeric_limits<double>::infinity();
  if (is_squarable(dot(to_light.direction, to_light.direction))) {
    return is_blocked(scene, to_light, end, light_index, region);
  }
  int k = 0;
  const Ray longer = along(to_light, rescaled(to_light.direction, k));
  return is_blocked(scene, longer, std::ldexp(end, -k), light_index, region);
}

}  // namespace tessera::render
