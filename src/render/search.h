// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "render/order.h"
#include "render/plane.h"
#include "render/ray.h"
#include "render/region.h"
#include "render/scene.h"
#include "render/sphere.h"

// What one ray asks of a scene, apart from how spheres are searched: a kernel offers spheres that the ray may meet, in
// any order and as often as it likes, and the answer is exact and the same.
namespace tessera::render {

/// The search for the first surface along a ray. Walls and planes it knows from the start.
/// requires: is_squarable(ray.direction); scene, ray and region outlive the search
class NearestSearch {
 public:
  /// Whether latest() comes nearer with what is found.
  static constexpr bool kCanShorten = true;

  NearestSearch(const Scene& scene, const Ray& ray, const Region& region) noexcept;

  const Ray& ray() const noexcept { return *ray_; }
  double inverse_length() const noexcept { return bounds_.inverse_length; }
  /// No hit after this can be the first.
  const double& latest() const noexcept { return latest_; }

  /// Returns whether the search is at its end, which it never is.
  bool offer(SurfaceId sphere) noexcept;

  /// The first surface of all that were offered, and how far it is.
  std::optional<Hit> finish() noexcept;

  /// The sphere that is surely entered before all else that was offered, if nothing is left to decide; else none.
  SurfaceId sure_entry() const noexcept;

 private:
  void look_at_walls() noexcept;
  void look_at_planes() noexcept;
  template <class WhereUnsure>
  void consider(const LookBounds& bounds, SurfaceId id, const Sphere& sphere, WhereUnsure&& where_unsure) noexcept;
  /// Makes a surface that is surely met the favourite, unless another may be met before it.
  void prefer(SurfaceId id, const Bounded& t) noexcept;
  /// Decides exactly whether, and where, a surface is met.
  void settle(SurfaceId id) noexcept;
  void take(SurfaceId id, Meeting meeting, const Bounded& t) noexcept;
  int side_of_plane(SurfaceId id) const noexcept { return region_->side_of(index_of(id) - scene_->sphere_count()); }
  std::optional<Hit> hit_of_favourite() const noexcept;
  std::optional<Hit> entry_hit(SurfaceId id) const noexcept;
  Hit plane_hit(SurfaceId id, double t) const noexcept;
  SurfacePoint sphere_point(SurfaceId id, const Vec3& normal) const noexcept;
  Vec3 exit_normal(SurfaceId id) const noexcept;

  const Scene* scene_;
  const Ray* ray_;
  const Region* region_;
  DirectionNorm norm_;
  LookBounds bounds_;
  double latest_ = std::numeric_limits<double>::infinity();
  Candidate best_;
  // First looks usually leave one favourite, met before all others; only what they cannot tell apart is settled.
  SurfaceId favourite_ = SurfaceId::none;
  double favourite_earliest_ = 0;
};

/// The search for a sphere that holds neither end of the path to a light and stands in it: where the line meets such
/// a sphere between its ends. As neither end is inside, it is enough that the point nearest to the centre lies between.
/// shapes:  the light is at to_light.origin + end to_light.direction, or infinitely far
/// requires: is_squarable(to_light.direction); scene, ray and region outlive the search
class OcclusionSearch {
 public:
  static constexpr bool kCanShorten = false;

  OcclusionSearch(const Scene& scene, const Ray& to_light, double end, std::size_t light, const Region& region) noexcept
      : scene_(&scene),
        ray_(&to_light),
        region_(&region),
        light_(light),
        norm_(norm_of(to_light.direction)),
        bounds_(look_bounds(norm_, scene.reach_from(to_light.origin))),
        end_(end) {}

  const Ray& ray() const noexcept { return *ray_; }
  double inverse_length() const noexcept { return bounds_.inverse_length; }
  const double& latest() const noexcept { return end_; }

  /// Returns whether the search is at its end: this sphere stands in the way.
  bool offer(SurfaceId sphere) noexcept;

  bool is_occluded() const noexcept { return is_occluded_; }

 private:
  bool blocks(SurfaceId id) const noexcept;

  const Scene* scene_;
  const Ray* ray_;
  const Region* region_;
  std::size_t light_;
  DirectionNorm norm_;
  LookBounds bounds_;
  double end_;
  bool is_occluded_ = false;
};

inline NearestSearch::NearestSearch(const Scene& scene, const Ray& ray, const Region& region) noexcept
    : scene_(&scene),
      ray_(&ray),
      region_(&region),
      norm_(norm_of(ray.direction)),
      bounds_(look_bounds(norm_, scene.reach_from(ray.origin))) {
  look_at_walls();
  look_at_planes();
}

// Spheres around the path: the far side is the hit. `ray.from` being that sphere, its own chord says where.
inline void NearestSearch::look_at_walls() noexcept {
  for (const SurfaceId id : region_->walls()) {
    const Sphere& sphere = scene_->sphere(id);
    if (ray_->from == id) {
      take(id, Meeting::own_exit, own_chord(*ray_, norm_, sphere.radius));
    } else {
      take(id, Meeting::exit, exit_from(*ray_, norm_, sphere.center, sphere.radius).t);
    }
  }
}

// Planes come before spheres: what lies behind one need not be searched.
inline void NearestSearch::look_at_planes() noexcept {
  const PlaneLookRay of_ray{norm_.length, sum_of_sizes(ray_->origin)};
  for (const std::size_t i : scene_->visible_planes()) {
    const SurfaceId id = scene_->plane_id(i);
    if (id == ray_->from) continue;
    const PlaneLook look(*ray_, of_ray, scene_->data().planes[i], scene_->plane_look(i), region_->side_of(i));
    if (look.surely_approaches()) {
      prefer(id, look.distance());
    } else if (!look.surely_recedes()) {
      settle(id);
    }
  }
}

// All spheres but the walls: the near side. A convex body that was just left cannot be met again.
inline bool NearestSearch::offer(SurfaceId id) noexcept {
  const Sphere& sphere = scene_->sphere(id);
  consider(bounds_, id, sphere, [&] {
    const LookBounds closer = closer_bounds(bounds_, ray_->origin, sphere.center, sphere.radius);
    consider(closer, id, sphere, [&] { settle(id); });
  });
  return false;
}

template <class WhereUnsure>
void NearestSearch::consider(const LookBounds& bounds, SurfaceId id, const Sphere& sphere,
                             WhereUnsure&& where_unsure) noexcept {
  const FirstLook look(*ray_, bounds, sphere.center, sphere.radius);
  if (look.surely_passes(bounds) || id == ray_->from || region_->is_inside(id)) return;
  if (look.surely_meets(bounds)) return prefer(id, look.entry(bounds));
  if (!look.surely_lies_behind(bounds)) where_unsure();
}

inline void NearestSearch::prefer(SurfaceId id, const Bounded& t) noexcept {
  if (id == favourite_ || t.value - t.error > latest_) return;
  const double t_latest = std::max(t.value + t.error, 0.0);
  if (favourite_ != SurfaceId::none && t_latest >= favourite_earliest_) {
    settle(favourite_);
    settle(id);
    favourite_ = SurfaceId::none;
    return;
  }
  favourite_ = id;
  favourite_earliest_ = t.value - t.error;
  latest_ = std::min(latest_, t_latest);
}

inline void NearestSearch::settle(SurfaceId id) noexcept {
  if (!scene_->is_sphere(id)) {
    if (const auto t = distance_to(scene_->plane(id), *ray_, side_of_plane(id), latest_)) take(id, Meeting::plane, *t);
    return;
  }
  // One that coincides with the sphere just left is as convex.
  if (scene_->are_coincident(id, ray_->from)) return;
  const Sphere& sphere = scene_->sphere(id);
  const auto crossing = entry_into(*ray_, norm_, sphere.center, sphere.radius);
  if (crossing) take(id, Meeting::entry, crossing->t);
}

inline void NearestSearch::take(SurfaceId id, Meeting meeting, const Bounded& t) noexcept {
  if (id == best_.surface) return;
  if (best_.surface != SurfaceId::none && !comes_first(*scene_, *ray_, {id, meeting, t}, best_)) return;
  best_.surface = id;
  best_.meeting = meeting;
  best_.t.value = t.value;
  best_.t.error = t.error;
  latest_ = std::min(latest_, best_.latest());
}

inline std::optional<Hit> NearestSearch::finish() noexcept {
  if (favourite_ != SurfaceId::none) {
    if (best_.surface == SurfaceId::none) return hit_of_favourite();
    settle(favourite_);
  }
  if (best_.surface == SurfaceId::none) return std::nullopt;
  switch (best_.meeting) {
    case Meeting::entry:
      return entry_hit(best_.surface);
    case Meeting::exit:
    case Meeting::own_exit:
      return Hit{sphere_point(best_.surface, exit_normal(best_.surface)), best_.t.value};
    case Meeting::plane:
      return plane_hit(best_.surface, best_.t.value);
  }
  return std::nullopt;
}

// Nothing else is left: where it is met is all that is asked.
inline std::optional<Hit> NearestSearch::hit_of_favourite() const noexcept {
  if (scene_->is_sphere(favourite_)) return entry_hit(favourite_);
  return plane_hit(favourite_, sure_distance_to(scene_->plane(favourite_), *ray_, side_of_plane(favourite_)));
}

inline std::optional<Hit> NearestSearch::entry_hit(SurfaceId id) const noexcept {
  const Sphere& sphere = scene_->sphere(id);
  const auto crossing = entry_into(*ray_, norm_, sphere.center, sphere.radius);
  if (!crossing) return std::nullopt;
  return Hit{sphere_point(id, normal_at(*crossing, ray_->direction)), crossing->t.value};
}

inline SurfaceId NearestSearch::sure_entry() const noexcept {
  const bool is_sure = best_.surface == SurfaceId::none && scene_->is_sphere(favourite_);
  return is_sure ? favourite_ : SurfaceId::none;
}

inline Hit NearestSearch::plane_hit(SurfaceId id, double t) const noexcept {
  return {{id, ray_->origin + t * ray_->direction, scene_->unit_normal(id)}, t};
}

inline SurfacePoint NearestSearch::sphere_point(SurfaceId id, const Vec3& normal) const noexcept {
  const Sphere& sphere = scene_->sphere(id);
  return {id, sphere.center + sphere.radius * normal, normal};
}

inline Vec3 NearestSearch::exit_normal(SurfaceId id) const noexcept {
  const Sphere& sphere = scene_->sphere(id);
  if (ray_->from != id) return normal_at(exit_from(*ray_, norm_, sphere.center, sphere.radius), ray_->direction);
  // Both ends of a chord lie symmetric to the plane through the centre across it.
  const double along = 2 * dot(ray_->from_normal, ray_->direction) / norm_.squared;
  return normalized(ray_->from_normal - along * ray_->direction);
}

inline bool OcclusionSearch::offer(SurfaceId id) noexcept {
  if (blocks(id)) is_occluded_ = true;
  return is_occluded_;
}

inline bool OcclusionSearch::blocks(SurfaceId id) const noexcept {
  const Sphere& sphere = scene_->sphere(id);
  const FirstLook look(*ray_, bounds_, sphere.center, sphere.radius);
  if (look.surely_passes(bounds_)) return false;
  if (id == ray_->from || region_->is_inside(id)) return false;
  // The light is on this sphere, on the side that the ray comes from: that is the end point, which is open.
  const Light& light = scene_->data().lights[light_];
  const bool touches_light = scene_->light_placement(light_).touches(id);
  if (touches_light && side_of_plane(light.vector, sphere.center, ray_->direction) <= 0) return false;
  if (!touches_light && look.surely_meets(bounds_) && look.is_surely_before(end_, bounds_)) return true;
  if (look.surely_lies_behind(bounds_)) return false;
  const LookBounds closer = closer_bounds(bounds_, ray_->origin, sphere.center, sphere.radius);
  const FirstLook second(*ray_, closer, sphere.center, sphere.radius);
  if (second.surely_passes(closer) || second.surely_lies_behind(closer)) return false;
  if (!touches_light && second.surely_meets(closer) && second.is_surely_before(end_, closer)) return true;
  if (scene_->are_coincident(id, ray_->from)) return false;
  const Passage passage = passage_of(*ray_, norm_, sphere.center, sphere.radius);
  const bool has_end = light.kind == LightKind::point && !touches_light;
  return line_meets(passage, *ray_, sphere.center, sphere.radius) && lies_ahead(passage, *ray_, sphere.center) &&
         (!has_end || nearest_point_comes_before(end_, passage, *ray_, norm_, sphere.center));
}

}  // namespace tessera::render
