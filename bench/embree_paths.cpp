// SPDX-License-Identifier: BSD-3-Clause
#include "embree_paths.h"

#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "embree_traversal.h"

namespace tessera::embree {
namespace {

/// A ray may meet its own surface nearer than this, in multiples of the numbers that its origin was computed from.
constexpr float kOwnSurface = 4e-6F;

/// What the rays met.
struct Surface {
  LaneMask is_hit;
  Wide point;
  Wide normal;  ///< unit, against the ray
  Lanes near;   ///< of the rays that leave it
  std::array<std::uint32_t, kLanes> material{};
};

/// The surfaces' materials.
struct Materials {
  Wide ambient, diffuse;
  Lanes specular, shininess, reflection;
};

/// Camera rays as functions of the pixel: origin and direction are linear in its place.
class WideCamera {
 public:
  explicit WideCamera(const render::CameraRays& camera) {
    const render::Ray corner = camera.through(0.5, 0.5);
    const render::Ray right = camera.through(1.5, 0.5);
    const render::Ray below = camera.through(0.5, 1.5);
    origin_ = to_float(corner.origin);
    origin_x_ = to_float(right.origin - corner.origin);
    origin_y_ = to_float(below.origin - corner.origin);
    direction_ = to_float(corner.direction);
    direction_x_ = to_float(right.direction - corner.direction);
    direction_y_ = to_float(below.direction - corner.direction);
  }

  Rays through(const Lanes& x, const Lanes& y) const {
    return {broadcast(origin_) + x * broadcast(origin_x_) + y * broadcast(origin_y_),
            normalized(broadcast(direction_) + x * broadcast(direction_x_) + y * broadcast(direction_y_)), 0,
            kInfinity};
  }

 private:
  Triple<float> origin_, origin_x_, origin_y_;
  Triple<float> direction_, direction_x_, direction_y_;
};

/// Follows the paths of eight pixels.
template <Hand hand>
class Painter {
 public:
  explicit Painter(const Scene& scene) : scene_(scene), tree_(scene.tree.get()) {
    rtcInitIntersectContext(&context_);
    context_.flags = hand == Hand::packet ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }

  Wide radiance_along(Rays rays, LaneMask active);
  const render::RayCounts& counts() const { return counts_; }

 private:
  Surface nearest(Rays rays, const LaneMask& active);
  Materials materials_of(const Surface& surface) const;
  Wide local_radiance(const Surface& surface, const Materials& material, const Wide& direction);
  Lanes highlight(const Materials& material, const Lanes& cosine) const;
  bool has_planes() const { return !scene_.planes.empty(); }

  const Scene& scene_;
  RTCScene tree_;
  RTCIntersectContext context_;
  render::RayCounts counts_;
};

std::uint64_t count_of(const LaneMask& mask) {
  return static_cast<std::uint64_t>(stdx::popcount(mask));
}

Lanes distance_to(const FloatPlane& plane, const Rays& rays) {
  const Wide normal = broadcast(plane.normal);
  return (plane.offset - dot(normal, rays.origin)) / dot(normal, rays.direction);
}

LaneMask is_cut_by_plane(const Scene& scene, const Rays& rays) {
  LaneMask is_cut(false);
  for (const FloatPlane& plane : scene.planes) {
    const Lanes t = distance_to(plane, rays);
    is_cut = is_cut || (t > rays.near && t < rays.far);
  }
  return is_cut;
}

template <Hand hand>
Surface Painter<hand>::nearest(Rays rays, const LaneMask& active) {
  // Planes first: they shorten the way through the tree.
  Surface surface;
  Wide plane_normal;
  for (const FloatPlane& plane : scene_.planes) {
    const Lanes t = distance_to(plane, rays);
    const LaneMask is_nearer = t > rays.near && t < rays.far;
    stdx::where(is_nearer, rays.far) = t;
    plane_normal = chosen(is_nearer, plane_normal, broadcast(plane.normal));
    for (std::size_t i = 0; i != kLanes; ++i) {
      if (is_nearer[i]) surface.material[i] = plane.material;
    }
  }
  const TreeHits hits = intersect<hand>(tree_, context_, rays, active);

  LaneMask is_sphere(false);
  Wide center;
  Lanes radius = 0;
  for (std::size_t i = 0; i != kLanes; ++i) {
    if (!active[i] || hits.sphere[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const FloatSphere& sphere = scene_.spheres[hits.sphere[i]];
    is_sphere[i] = true;
    set(center, i, {sphere.x, sphere.y, sphere.z});
    radius[i] = sphere.radius;
    surface.material[i] = scene_.sphere_materials[hits.sphere[i]];
  }
  surface.is_hit = is_sphere;

  // A point on a sphere is best taken from the sphere: the way along the ray costs digits.
  surface.normal = normalized(hits.normal);
  surface.point = center + radius * surface.normal;
  if (has_planes()) {
    surface.is_hit = active && (is_sphere || rays.far < kInfinity);
    surface.normal = chosen(is_sphere, plane_normal, surface.normal);
    surface.point = chosen(is_sphere, rays.origin + rays.far * rays.direction, surface.point);
    stdx::where(!is_sphere, radius) = rays.far;
  }
  surface.normal = chosen(dot(surface.normal, rays.direction) > 0.0F, surface.normal, Lanes(-1) * surface.normal);
  surface.near = kOwnSurface * stdx::max(radius, largest_component(surface.point));
  return surface;
}

template <Hand hand>
Materials Painter<hand>::materials_of(const Surface& surface) const {
  Materials all;
  for (std::size_t i = 0; i != kLanes; ++i) {
    const FloatMaterial& material = scene_.materials[surface.material[i]];
    set(all.ambient, i, material.ambient);
    set(all.diffuse, i, material.diffuse);
    all.specular[i] = material.specular;
    all.shininess[i] = material.shininess;
    all.reflection[i] = material.reflection;
  }
  return all;
}

/// specular cosine^shininess.
/// shapes:  cosine in [0, 1]
template <Hand hand>
Lanes Painter<hand>::highlight(const Materials& material, const Lanes& cosine) const {
  if (scene_.has_whole_shininess) return material.specular * whole_power(cosine, material.shininess);
  Lanes power;
  for (std::size_t i = 0; i != kLanes; ++i) power[i] = std::pow(float(cosine[i]), float(material.shininess[i]));
  return material.specular * power;
}

/// Ambient light and every light that reaches the surface.
template <Hand hand>
Wide Painter<hand>::local_radiance(const Surface& surface, const Materials& material, const Wide& direction) {
  Wide sum = material.ambient;
  const LaneMask is_seen = surface.is_hit && material.reflection < 1.0F;
  const Wide mirrored = direction - (2.0F * dot(surface.normal, direction)) * surface.normal;
  for (const FloatLight& light : scene_.lights) {
    Rays rays{surface.point, broadcast(light.vector), surface.near, kInfinity};
    if (light.is_point) {
      const Wide reach = rays.direction - surface.point;
      rays.far = sqrt(dot(reach, reach));
      rays.direction = (1.0F / rays.far) * reach;
    }
    const Lanes n_l = dot(surface.normal, rays.direction);
    LaneMask is_lit = is_seen && n_l > 0.0F;
    if (has_planes()) is_lit = is_lit && !is_cut_by_plane(scene_, rays);
    if (stdx::none_of(is_lit)) continue;
    counts_.shadow += count_of(is_lit);
    is_lit = is_lit && !is_occluded<hand>(tree_, context_, rays, is_lit);
    if (stdx::none_of(is_lit)) continue;

    const Lanes cosine = stdx::min(dot(rays.direction, mirrored), Lanes(1));
    const LaneMask has_highlight = is_lit && cosine > 0.0F;
    const Lanes white = masked(has_highlight, highlight(material, masked(has_highlight, cosine)));
    sum += broadcast(light.color) * (masked(is_lit, n_l) * material.diffuse + Wide{white, white, white});
  }
  return sum;
}

/// Radiance at the origins of camera rays: (1 - k) local + k mirrored at each surface, the background at the end.
template <Hand hand>
Wide Painter<hand>::radiance_along(Rays rays, LaneMask active) {
  counts_.primary += count_of(active);
  const Wide background = broadcast(scene_.background);
  Wide sum;
  Lanes weight = 1;
  for (std::uint32_t bounce = 0;; ++bounce) {
    const Surface surface = nearest(rays, active);
    sum += masked(active && !surface.is_hit, weight) * background;
    active = surface.is_hit;
    if (stdx::none_of(active)) return sum;

    const Materials material = materials_of(surface);
    sum += masked(active, weight * (1.0F - material.reflection)) * local_radiance(surface, material, rays.direction);
    weight *= material.reflection;
    active = active && weight > 0.0F;
    if (stdx::none_of(active)) return sum;
    if (bounce == scene_.max_bounces) return sum + masked(active, weight) * background;

    const Wide mirrored = rays.direction - (2.0F * dot(surface.normal, rays.direction)) * surface.normal;
    rays = {surface.point, mirrored, surface.near, kInfinity};
    counts_.mirror += count_of(active);
  }
}

/// Blocks of 4x2 pixels in tiles that stay in the caches.
template <Hand hand>
Picture paint(const Scene& scene, const WideCamera& camera, std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t kTile = 16;
  constexpr std::uint32_t kBlockWidth = 4;
  constexpr std::uint32_t kBlockHeight = 2;
  static_assert(kBlockWidth * kBlockHeight == kLanes);
  const Lanes in_block_x([](auto i) { return static_cast<float>(i % kBlockWidth); });
  const Lanes in_block_y([](auto i) { return static_cast<float>(i / kBlockWidth); });

  Picture picture;
  picture.pixels.resize(std::size_t{width} * height);
  Painter<hand> painter(scene);
  const auto paint_block = [&](std::uint32_t left, std::uint32_t top) {
    const Lanes x = static_cast<float>(left) + in_block_x;
    const Lanes y = static_cast<float>(top) + in_block_y;
    const LaneMask is_inside = x < static_cast<float>(width) && y < static_cast<float>(height);
    const Wide color = painter.radiance_along(camera.through(x, y), is_inside);
    for (std::uint32_t i = 0; i != kLanes; ++i) {
      if (!is_inside[i]) continue;
      const std::size_t row = top + i / kBlockWidth;
      picture.pixels[row * width + left + i % kBlockWidth] = {color.x[i], color.y[i], color.z[i]};
    }
  };
  for (std::uint32_t top = 0; top < height; top += kTile) {
    for (std::uint32_t left = 0; left < width; left += kTile) {
      for (std::uint32_t y = top; y < std::min(top + kTile, height); y += kBlockHeight) {
        for (std::uint32_t x = left; x < std::min(left + kTile, width); x += kBlockWidth) paint_block(x, y);
      }
    }
  }
  picture.rays = painter.counts();
  return picture;
}

}  // namespace

Picture draw(const Scene& scene, const render::CameraRays& camera, std::uint32_t width, std::uint32_t height,
             Mode mode) {
  constexpr unsigned kFlushToZero = 0x8000;
  constexpr unsigned kDenormalsAreZero = 0x0040;
  _mm_setcsr(_mm_getcsr() | kFlushToZero | kDenormalsAreZero);  // as Embree's manual advises
  const WideCamera rays(camera);
  return mode == Mode::single ? paint<Hand::one_by_one>(scene, rays, width, height)
                              : paint<Hand::packet>(scene, rays, width, height);
}

}  // namespace tessera::embree
