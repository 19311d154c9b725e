// SPDX-License-Identifier: BSD-3-Clause
#include "render/reference/quad_tracer.h"

#include <cmath>

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

Quad floor_of(Quad a) {
  const Quad whole = static_cast<Quad>(static_cast<std::int64_t>(a));
  return whole > a ? whole - 1 : whole;
}

}  // namespace

QuadTracer::QuadTracer(const SceneData& scene, const Vec3& eye, const Vec3& direction)
    : scene_(scene), eye_(eye), direction_(direction) {
  for (const Sphere& sphere : scene.spheres) {
    const QuadVec f = QuadVec(sphere.center) - eye_;
    const int side = sign(quad_dot(f, f) - Quad(sphere.radius) * sphere.radius);
    inside_.push_back(sphere.radius > 0 && (side < 0 || (side == 0 && quad_dot(f, direction_) > 0)));
  }
  for (const Plane& plane : scene.planes) {
    const int side = sign(quad_dot(plane.normal, eye_ - QuadVec(plane.point)));
    side_.push_back(side != 0 ? side : sign(quad_dot(plane.normal, direction_)));
  }
}

std::optional<Quad> QuadTracer::distance_to(std::size_t surface, const QuadRay& ray) const {
  if (surface < scene_.spheres.size()) {
    const Sphere& sphere = scene_.spheres[surface];
    if (!(sphere.radius > 0) || (surface == ray.from && !inside_[surface])) return std::nullopt;
    if (surface == ray.from) {
      return 2 * Quad(sphere.radius) * quad_dot(ray.from_normal, ray.direction) /
             quad_dot(ray.direction, ray.direction);
    }
    const QuadRoots roots(ray.origin, ray.direction, sphere.center, sphere.radius);
    if (inside_[surface]) return roots.far > 0 ? roots.far : 0;
    const bool approaches = quad_dot(QuadVec(sphere.center) - ray.origin, ray.direction) > 0;
    if (roots.discriminant < 0 || !approaches) return std::nullopt;
    return roots.near > 0 ? roots.near : 0;
  }
  const std::size_t index = surface - scene_.spheres.size();
  const Plane& plane = scene_.planes[index];
  const Quad towards = quad_dot(plane.normal, ray.direction);
  if (surface == ray.from || !(side_[index] * towards < 0)) return std::nullopt;
  const Quad t = quad_dot(plane.normal, QuadVec(plane.point) - ray.origin) / towards;
  return t > 0 ? t : 0;
}

std::optional<QuadHit> QuadTracer::nearest(const QuadRay& ray) const {
  std::optional<QuadHit> best;
  for (std::size_t i = 0; i != scene_.spheres.size() + scene_.planes.size(); ++i) {
    const std::optional<Quad> t = distance_to(i, ray);
    if (t && (!best || *t < best->t)) best = QuadHit{i, *t, {}, {}};
  }
  if (!best) return best;
  best->point = ray.origin + best->t * ray.direction;
  if (best->surface < scene_.spheres.size()) {
    const QuadVec outward = quad_unit(best->point - QuadVec(scene_.spheres[best->surface].center));
    best->normal = inside_[best->surface] ? Quad(-1) * outward : outward;
  } else {
    const std::size_t plane = best->surface - scene_.spheres.size();
    best->normal = Quad(side_[plane]) * quad_unit(scene_.planes[plane].normal);
  }
  return best;
}

bool QuadTracer::is_blocked(const QuadRay& ray, const Light& light) const {
  for (std::size_t i = 0; i != scene_.spheres.size() + scene_.planes.size(); ++i) {
    const std::optional<Quad> t = distance_to(i, ray);
    if (t && (light.kind == LightKind::directional || *t < 1)) return true;
  }
  return false;
}

QuadVec QuadTracer::local_light(const QuadHit& hit, const QuadVec& to_viewer) const {
  const Material& material = material_of(hit);
  QuadVec sum = Quad(material.ambient) * channelwise(color(scene_.environment.ambient), color(material.color));
  for (const Light& light : scene_.lights) {
    const bool is_point = light.kind == LightKind::point;
    const QuadVec to_light = is_point ? QuadVec(light.vector) - hit.point : Quad(-1) * QuadVec(light.vector);
    const Quad n_l = quad_dot(hit.normal, to_light);
    if (!(n_l > 0) || is_blocked({hit.point, to_light, hit.surface, hit.normal}, light)) continue;
    const QuadVec l = quad_unit(to_light);
    const Quad cosine = n_l / quad_length(to_light);
    QuadVec term = Quad(material.diffuse) * cosine * color(material.color);
    const Quad phong = quad_dot(2 * cosine * hit.normal - l, to_viewer);
    const Quad blinn = quad_dot(hit.normal, quad_unit(l + to_viewer));
    const Quad base = scene_.image.shade == Shade::phong ? phong : blinn;
    if (base > 0) {
      const Quad highlight = Quad(material.specular) * std::pow(static_cast<double>(base), material.shininess);
      term = term + QuadVec(highlight, highlight, highlight);
    }
    sum = sum + channelwise(color(light.color), term);
  }
  return sum;
}

QuadVec QuadTracer::radiance_along(const QuadRay& ray, std::uint32_t bounces_left) const {
  const std::optional<QuadHit> hit = nearest(ray);
  if (!hit) return color(scene_.environment.background);
  const QuadVec local = local_light(*hit, quad_unit(Quad(-1) * ray.direction));
  const Quad k = material_of(*hit).reflection;
  if (!(k > 0)) return local;
  const QuadVec mirrored = ray.direction - 2 * quad_dot(ray.direction, hit->normal) * hit->normal;
  const QuadVec seen = bounces_left == 0
                           ? color(scene_.environment.background)
                           : radiance_along({hit->point, mirrored, hit->surface, hit->normal}, bounces_left - 1);
  return (1 - k) * local + k * seen;
}

const Material& QuadTracer::material_of(const QuadHit& hit) const {
  MaterialIndex index{};
  if (hit.surface < scene_.spheres.size()) {
    index = scene_.spheres[hit.surface].material;
  } else {
    const Plane& plane = scene_.planes[hit.surface - scene_.spheres.size()];
    index = plane.material;
    if (plane.checker) {
      const QuadVec n = quad_unit(plane.normal);
      const Quad ax = magnitude(n.x);
      const Quad ay = magnitude(n.y);
      const Quad az = magnitude(n.z);
      const QuadVec e = ax <= ay && ax <= az ? QuadVec(1, 0, 0) : ay <= az ? QuadVec(0, 1, 0) : QuadVec(0, 0, 1);
      const QuadVec u = quad_unit(quad_cross(e, n));
      const QuadVec from_origin = hit.point - QuadVec(plane.point);
      const Quad size = plane.checker->size;
      const Quad cell =
          floor_of(quad_dot(from_origin, u) / size) + floor_of(quad_dot(from_origin, quad_cross(n, u)) / size);
      if (cell != 2 * floor_of(cell / 2)) index = plane.checker->material;
    }
  }
  return scene_.materials[static_cast<std::size_t>(index)];
}

}  // namespace tessera::render::reference
