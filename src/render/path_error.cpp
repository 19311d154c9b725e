// SPDX-License-Identifier: BSD-3-Clause
#include "render/path_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/intersect.h"
#include "render/plane.h"
#include "render/power.h"
#include "render/sphere.h"

namespace tessera::render {
namespace {

constexpr double u = kUnitRoundoff;

double largest_channel(const Rgb& c) {
  return std::max({c.r, c.g, c.b});
}

}  // namespace

void PathError::on_hit(const PathVertex& vertex) {
  if (!is_certified_) return;
  const bool is_sphere = scene_.is_sphere(vertex.hit.surface);
  const std::optional<HitError> error = error_at(vertex);
  if (!error) return give_up();
  check_first(vertex.ray, vertex.hit.surface, error->latest);
  if (!is_sphere) check_cell(scene_.plane(vertex.hit.surface), vertex.hit.point, error->mirrored.position);

  const double k = vertex.material.reflection;
  place_ = {vertex.hit.surface,
            vertex.hit.point,
            vertex.normal,
            normalized(-vertex.ray.direction),
            &vertex.material,
            (1 - k) * vertex.weight,
            error->mirrored.position,
            error->normal,
            ray_error_.direction};
  remaining_weight_ = k * vertex.weight;
  ++vertices_;
  add(scene_.data().environment.ambient * (vertex.material.ambient * vertex.material.color), {});

  ray_error_ = error->mirrored;
}

std::optional<HitError> PathError::error_at(const PathVertex& vertex) {
  const auto& [ray, hit, cell, normal, material, weight] = vertex;
  if (!scene_.is_sphere(hit.surface)) {
    const int side = region_.side_of(index_of(hit.surface) - scene_.sphere_count());
    return error_of_hit(scene_.plane(hit.surface), side, ray, hit, ray_error_);
  }
  const Sphere& sphere = scene_.sphere(hit.surface);
  if (hit.surface == ray.from) {
    const double chord_error = error_of_chord(sphere.radius, place_.normal_error, ray_error_);
    return inner_run_.next(sphere, hit, hit.t * length(ray.direction), chord_error);
  }
  const bool is_inside = region_.is_inside(hit.surface);
  const auto error = error_of_hit(sphere, is_inside ? SphereSide::inner : SphereSide::outer, ray, hit, ray_error_);
  if (error && is_inside) inner_run_ = InnerRun(*error);
  return error;
}

void PathError::on_miss(const Ray& ray, double) {
  if (is_certified_) check_first(ray, SurfaceId::none, std::numeric_limits<double>::infinity());
}

double PathError::bound() const noexcept {
  if (!is_certified_) return std::numeric_limits<double>::infinity();
  // Each term is a product of few factors, one of them a product of the mirrors before it; each sum is of such terms.
  const double lights = static_cast<double>(scene_.data().lights.size());
  const double roundings = (32 + lights + 4 * vertices_) * u;
  const Rgb radiance = radiance_ + remaining_weight_ * scene_.data().environment.background;
  const double bound = largest_channel(error_ + roundings * radiance) + std::numeric_limits<double>::min();
  return bound >= 0 ? bound : std::numeric_limits<double>::infinity();
}

// A camera ray is exact, and so is what it meets first.
void PathError::check_first(const Ray& ray, SurfaceId hit, double latest) {
  if (vertices_ == 0) return;
  const Vec3 direction = normalized(ray.direction);
  // The tube begins where the true origin may be, which is rounded once more.
  const double line_error = kSecondOrder * ray_error_.line + 2 * u * length(ray.origin);
  const Tube tube(ray.origin - ray_error_.position * direction, direction, latest + ray_error_.position, line_error,
                  kSecondOrder * ray_error_.direction);
  const auto is_other = [&](SurfaceId id) {
    return id != hit && id != ray.from && !scene_.are_coincident(id, hit) && !scene_.are_coincident(id, ray.from);
  };

  scene_.visit_where([&](const Box& box) { return is_certified_ && tube.may_meet(box); },
                     [&](SurfaceId id) {
                       if (!is_other(id) || region_.is_inside(id)) return;
                       const Sphere& sphere = scene_.sphere(id);
                       if (!tube.surely_passes(sphere.center, sphere.radius)) give_up();
                     });
  for (const SurfaceId id : region_.walls()) {
    const Sphere& wall = scene_.sphere(id);
    if (is_other(id) && !tube.surely_stays_in(wall.center, wall.radius)) give_up();
    if (id == ray.from && id != hit) {
      const double chord = 2 * wall.radius * std::abs(dot(ray.from_normal, direction));
      if (!(chord - error_of_chord(wall.radius, place_.normal_error, ray_error_) > latest)) give_up();
    }
  }
  for (const std::size_t i : scene_.visible_planes()) {
    const SurfaceId id = scene_.plane_id(i);
    if (!is_other(id)) continue;
    if (!tube.surely_stays_beside(scene_.plane(id).point, scene_.unit_normal(id), region_.side_of(i))) give_up();
  }
}

void PathError::check_cell(const Plane& plane, const Vec3& point, double position_error) {
  if (!plane.checker) return;
  const CheckerAxes axes(plane);
  const Vec3 offset = point - plane.point;
  const double error = kSecondOrder * position_error + kUnitRounding * length(offset);
  for (const Vec3& axis : {axes.u, axes.v}) {
    const double way = dot(offset, axis);
    const double cell = std::floor((way - error) / plane.checker->size);
    // From 2^53 on, doubles cannot tell an even cell from an odd one.
    if (!(std::abs(cell) < 0x1p53) || cell != std::floor((way + error) / plane.checker->size)) give_up();
  }
}

void PathError::on_light(std::size_t index, bool is_lit) {
  const Light& light = scene_.data().lights[index];
  if (!is_certified_ || light.color == Rgb{}) return;
  if (!is_on_path_side(scene_, index, place_.surface, region_)) return;

  // The way to the light, and how far its direction may be off.
  const bool is_point = light.kind == LightKind::point;
  const Vec3 way = is_point ? light.vector - place_.point : -light.vector;
  const double distance = is_point ? length(way) : std::numeric_limits<double>::infinity();
  if (!(place_.position_error < kLinearLimit * distance)) return give_up();
  const Vec3 to_light = normalized(way);
  const double way_error = kSecondOrder * place_.position_error / distance + kUnitRounding;

  const double n_l = dot(place_.normal, to_light);
  const double n_l_error = place_.normal_error + way_error + kUnitRounding;
  if (std::abs(n_l) <= n_l_error) return give_up();
  if (n_l < 0 || is_shut_off(scene_, index, region_)) return;
  check_shadow(index, is_lit, to_light, distance, way_error);
  if (!is_lit) return;

  const Material& material = *place_.material;
  const Highlight highlight = highlight_of(to_light, n_l, n_l_error, way_error);
  const auto reflected = [&](double diffuse, double specular) {
    return light.color * (material.diffuse * diffuse * material.color + material.specular * specular * Rgb{1, 1, 1});
  };
  add(reflected(n_l, highlight.value), reflected(n_l_error, highlight.error));
}

void PathError::check_shadow(std::size_t index, bool is_lit, const Vec3& to_light, double distance, double way_error) {
  const Light& light = scene_.data().lights[index];
  const Placement& placement = scene_.light_placement(index);
  const double rounded_end = light.kind == LightKind::point ? 2 * u * distance : 0;
  const Tube tube(place_.point, to_light, distance, kSecondOrder * place_.position_error + rounded_end, 0);
  bool is_surely_blocked = false;
  bool is_surely_free = true;
  scene_.visit_where([&](const Box& box) { return is_certified_ && tube.may_meet(box); },
                     [&](SurfaceId id) {
                       if (id == place_.surface || region_.is_inside(id)) return;
                       if (scene_.are_coincident(id, place_.surface)) return;
                       const Sphere& sphere = scene_.sphere(id);
                       if (placement.touches(id)) {
                         // It blocks where the light is on its far side.
                         const double depth = dot(light.vector - sphere.center, to_light) / sphere.radius;
                         if (depth < -2 * way_error) return;
                         is_surely_free = false;
                         is_surely_blocked = is_surely_blocked || depth > 2 * way_error;
                         return;
                       }
                       if (tube.surely_passes(sphere.center, sphere.radius)) return;
                       is_surely_free = false;
                       is_surely_blocked = is_surely_blocked || tube.surely_enters(sphere.center, sphere.radius);
                     });
  if (is_lit ? !is_surely_free : !is_surely_blocked) give_up();
}

PathError::Highlight PathError::highlight_of(const Vec3& to_light, double n_l, double n_l_error,
                                             double way_error) const {
  const Material& material = *place_.material;
  if (material.specular == 0) return {};
  double cosine = 0;
  double error = 0;
  if (shade_ == Shade::phong) {
    const double n_v = dot(place_.normal, place_.to_viewer);
    cosine = 2 * n_l * n_v - dot(to_light, place_.to_viewer);
    const double n_v_error = place_.normal_error + place_.direction_error + kUnitRounding;
    error = 2 * (n_l_error + n_v_error) + way_error + place_.direction_error + kUnitRounding;
  } else {
    const Vec3 sum = to_light + place_.to_viewer;
    cosine = dot(place_.normal, normalized(sum));
    error =
        place_.normal_error + 2 * (way_error + place_.direction_error + kUnitRounding) / length(sum) + kUnitRounding;
  }
  const double most = cosine + kSecondOrder * error;
  const double least = cosine - kSecondOrder * error;
  if (!(most > 0)) return {};
  const auto raised = [&](double base) { return power(std::clamp(base, 0.0, 1.0), material.shininess); };
  const double highest = raised(most);
  const double lowest = least > 0 ? raised(least) : 0;
  return {cosine > 0 ? raised(cosine) : 0, highest - lowest + (24 + 3 * material.shininess) * u * highest};
}

void PathError::add(const Rgb& term, const Rgb& error) {
  radiance_ += place_.weight * term;
  error_ += place_.weight * error;
}

}  // namespace tessera::render
