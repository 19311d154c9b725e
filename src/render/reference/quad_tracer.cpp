// SPDX-License-Identifier: BSD-3-Clause
#include "render/reference/quad_tracer.h"

#include <limits>

#include "render/reference/quad_power.h"

namespace tessera::render::reference {
namespace {

int sign(Quad a) {
  return a < 0 ? -1 : a > 0 ? 1 : 0;
}

QuadVec color(const Rgb& c) {
  return {c.r, c.g, c.b};
}

QuadVec channelwise(const QuadVec& a, const QuadVec& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// The largest whole number not above a, which keeps its quad precision where no integer type is wide enough.
Quad floor_of(Quad a) {
  constexpr Quad kAllWhole = 0x1p112;  // from here on there is no fraction
  if (magnitude(a) >= kAllWhole) return a;
  // Adding and taking away what leaves no room for a fraction rounds to a whole number.
  const Quad whole = a < 0 ? (a - kAllWhole) + kAllWhole : (a + kAllWhole) - kAllWhole;
  return whole > a ? whole - 1 : whole;
}

/// From a point to a light: as far as it is, or of any length where the light is infinitely far.
QuadVec towards(const Light& light, const QuadVec& point) {
  return light.kind == LightKind::point ? QuadVec(light.vector) - point : Quad(-1) * QuadVec(light.vector);
}

bool is_on(const Sphere& sphere, const QuadVec& point) {
  const QuadVec f = QuadVec(sphere.center) - point;
  return quad_dot(f, f) == Quad(sphere.radius) * sphere.radius;
}
bool is_on(const Plane& plane, const QuadVec& point) {
  return quad_dot(plane.normal, point - QuadVec(plane.point)) == 0;
}

}  // namespace

QuadTracer::QuadTracer(const SceneView& scene, const Vec3& eye, const Vec3& direction)
    : scene_(scene), camera_ray_{eye, direction, kNone, {}} {
  for (const Sphere& sphere : scene.spheres) {
    const QuadVec f = QuadVec(sphere.center) - camera_ray_.origin;
    const int side = sign(quad_dot(f, f) - Quad(sphere.radius) * sphere.radius);
    inside_.push_back(sphere.radius > 0 && (side < 0 || (side == 0 && quad_dot(f, camera_ray_.direction) > 0)));
  }
  for (const Plane& plane : scene.stage.planes) {
    const int side = sign(quad_dot(plane.normal, camera_ray_.origin - QuadVec(plane.point)));
    side_.push_back(side != 0 ? side : sign(quad_dot(plane.normal, camera_ray_.direction)));
  }
}

std::optional<Quad> QuadTracer::distance_to(std::size_t surface, const QuadRay& ray) const {
  if (surface < scene_.spheres.size()) {
    const Sphere& sphere = scene_.spheres[surface];
    const bool is_own = ray.from != kNone && coincide(surface, ray.from);
    if (!(sphere.radius > 0) || (is_own && !inside_[surface])) return std::nullopt;
    if (is_own) {
      return 2 * Quad(sphere.radius) * quad_dot(ray.from_normal, ray.direction) /
             quad_dot(ray.direction, ray.direction);
    }
    const QuadLine line(ray.origin, ray.direction, sphere.center, sphere.radius);
    if (inside_[surface]) {
      const Quad far = line.far();
      return far > 0 ? far : 0;
    }
    if (line.discriminant < 0 || !(line.b > 0)) return std::nullopt;
    const Quad near = line.near();
    return near > 0 ? near : 0;
  }
  const std::size_t index = surface - scene_.spheres.size();
  const Plane& plane = scene_.stage.planes[index];
  const Quad towards = quad_dot(plane.normal, ray.direction);
  const bool is_own = ray.from != kNone && coincide(surface, ray.from);
  if (is_own || !(side_[index] * towards < 0)) return std::nullopt;
  const Quad t = quad_dot(plane.normal, QuadVec(plane.point) - ray.origin) / towards;
  return t > 0 ? t : 0;
}

bool QuadTracer::coincide(std::size_t a, std::size_t b) const {
  const std::size_t spheres = scene_.spheres.size();
  if ((a < spheres) != (b < spheres)) return false;
  return a < spheres ? render::coincide(scene_.spheres[a], scene_.spheres[b])
                     : render::coincide(scene_.stage.planes[a - spheres], scene_.stage.planes[b - spheres]);
}

std::optional<QuadHit> QuadTracer::nearest(const QuadRay& ray) const {
  std::optional<QuadHit> best;
  for (std::size_t i = 0; i != scene_.spheres.size() + scene_.stage.planes.size(); ++i) {
    const std::optional<Quad> t = distance_to(i, ray);
    if (t && (!best || (*t < best->t && !coincide(i, best->surface)))) best = QuadHit{i, *t, {}, {}};
  }
  if (!best) return best;
  best->point = ray.origin + best->t * ray.direction;
  if (best->surface < scene_.spheres.size()) {
    // From the centre, not from the origin of the coordinates: beside that a tiny sphere would vanish.
    const QuadVec from_center = ray.origin - QuadVec(scene_.spheres[best->surface].center);
    const QuadVec outward = quad_unit(from_center + best->t * ray.direction);
    best->normal = inside_[best->surface] ? Quad(-1) * outward : outward;
  } else {
    const std::size_t plane = best->surface - scene_.spheres.size();
    best->normal = Quad(side_[plane]) * quad_unit(scene_.stage.planes[plane].normal);
  }
  return best;
}

bool QuadTracer::is_blocked(const QuadRay& ray, const Light& light) const {
  for (std::size_t i = 0; i != scene_.spheres.size() + scene_.stage.planes.size(); ++i) {
    const std::optional<Quad> t = distance_to(i, ray);
    if (!t) continue;
    if (light.kind == LightKind::directional) return true;
    // Of a surface that the light is on, rounding cannot tell the end point, which is open, from one before it.
    const bool is_end = ends_at_light(i, ray, light.vector);
    if (!is_end && (*t < 1 || is_on_surface(i, light.vector))) return true;
  }
  return false;
}

bool QuadTracer::is_on_surface(std::size_t surface, const QuadVec& point) const {
  const std::size_t spheres = scene_.spheres.size();
  return surface < spheres ? is_on(scene_.spheres[surface], point)
                           : is_on(scene_.stage.planes[surface - spheres], point);
}

/// A ray to a light on a surface meets that at the light, unless it comes through the sphere from its far side.
bool QuadTracer::ends_at_light(std::size_t surface, const QuadRay& ray, const QuadVec& light) const {
  if (!is_on_surface(surface, light)) return false;
  if (surface >= scene_.spheres.size() || inside_[surface]) return true;
  return !(quad_dot(light - QuadVec(scene_.spheres[surface].center), ray.direction) > 0);
}

bool QuadTracer::is_lit(const QuadHit& hit, const Light& light, RayCounts& counts) const {
  const QuadVec to_light = towards(light, hit.point);
  // Any point of a plane tells its side, and the one it is given by is not rounded.
  const std::size_t spheres = scene_.spheres.size();
  const QuadVec foot = hit.surface < spheres ? hit.point : QuadVec(scene_.stage.planes[hit.surface - spheres].point);
  if (!(quad_dot(hit.normal, towards(light, foot)) > 0)) return false;
  ++counts.shadow;
  return !is_blocked({hit.point, to_light, hit.surface, hit.normal}, light);
}

QuadVec QuadTracer::reflected_light(const QuadHit& hit, const Material& material, const QuadVec& to_viewer,
                                    Signature& signature, RayCounts& counts) const {
  QuadVec sum = Quad(material.ambient) * channelwise(color(scene_.stage.environment.ambient), color(material.color));
  if (material.diffuse == 0 && material.specular == 0) return sum;
  for (const Light& light : scene_.stage.lights) {
    const bool lit = is_lit(hit, light, counts);
    signature.light(lit);
    if (!lit) continue;
    const QuadVec l = quad_unit(towards(light, hit.point));
    const Quad cosine = quad_dot(hit.normal, l);
    QuadVec term = Quad(material.diffuse) * cosine * color(material.color);
    const Quad base = scene_.stage.image.shade == Shade::phong ? quad_dot(2 * cosine * hit.normal - l, to_viewer)
                                                               : quad_dot(hit.normal, quad_unit(l + to_viewer));
    if (base > 0) {
      const Quad highlight = Quad(material.specular) * quad_power(base < 1 ? base : 1, material.shininess);
      term = term + QuadVec(highlight, highlight, highlight);
    }
    sum = sum + channelwise(color(light.color), term);
  }
  return sum;
}

QuadVec QuadTracer::radiance(Signature& signature, RayCounts& counts) const {
  QuadVec radiance;
  Quad weight = 1;
  QuadRay ray = camera_ray_;
  ++counts.primary;
  for (std::uint32_t bounce = 0;; ++bounce) {
    const std::optional<QuadHit> hit = nearest(ray);
    if (!hit) {
      signature.miss();
      break;
    }
    const Cell cell = cell_of(*hit);
    const Material& material = material_of(*hit, cell);
    signature.meet(surface_id(hit->surface), cell);
    const Quad k = material.reflection;
    if (k < 1) {
      const QuadVec to_viewer = quad_unit(Quad(-1) * ray.direction);
      radiance = radiance + weight * (1 - k) * reflected_light(*hit, material, to_viewer, signature, counts);
    }
    weight *= k;
    // No double can tell what is left from nothing.
    if (weight < std::numeric_limits<double>::min()) return radiance;
    if (bounce == scene_.stage.image.max_bounces) break;
    ++counts.mirror;
    const QuadVec mirrored = ray.direction - 2 * quad_dot(ray.direction, hit->normal) * hit->normal;
    ray = {hit->point, mirrored, hit->surface, hit->normal};
  }
  return radiance + weight * color(scene_.stage.environment.background);
}

QuadVec QuadTracer::radiance() const {
  Signature signature;
  RayCounts counts;
  return radiance(signature, counts);
}

const Material& QuadTracer::material_of(const QuadHit& hit, Cell cell) const {
  const std::size_t spheres = scene_.spheres.size();
  const MaterialIndex index = hit.surface < spheres ? scene_.spheres[hit.surface].material
                              : cell == Cell::odd   ? scene_.stage.planes[hit.surface - spheres].checker->material
                                                    : scene_.stage.planes[hit.surface - spheres].material;
  return scene_.materials[static_cast<std::size_t>(index)];
}

Cell QuadTracer::cell_of(const QuadHit& hit) const {
  if (hit.surface < scene_.spheres.size()) return Cell::even;
  const Plane& plane = scene_.stage.planes[hit.surface - scene_.spheres.size()];
  if (!plane.checker) return Cell::even;
  const QuadVec n = quad_unit(plane.normal);
  const Quad ax = magnitude(plane.normal.x);
  const Quad ay = magnitude(plane.normal.y);
  const Quad az = magnitude(plane.normal.z);
  const QuadVec e = ax <= ay && ax <= az ? QuadVec(1, 0, 0) : ay <= az ? QuadVec(0, 1, 0) : QuadVec(0, 0, 1);
  const QuadVec u = quad_unit(quad_cross(e, n));
  const QuadVec from_origin = hit.point - QuadVec(plane.point);
  const Quad size = plane.checker->size;
  const Quad cell =
      floor_of(quad_dot(from_origin, u) / size) + floor_of(quad_dot(from_origin, quad_cross(n, u)) / size);
  return cell == 2 * floor_of(cell / 2) ? Cell::even : Cell::odd;
}

}  // namespace tessera::render::reference
