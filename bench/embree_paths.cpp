// SPDX-License-Identifier: BSD-3-Clause
#include "embree_paths.h"

#include <xmmintrin.h>

#include <algorithm>
#include <cmath>

#include "embree_traversal.h"

namespace tessera::embree {
namespace {

/// A ray may meet its own surface nearer than this, in multiples of the numbers that its origin was computed from.
constexpr float kOwnSurface = 4e-6F;

/// How each kind of ray is handed over.
struct Hands {
  Hand camera;
  Hand shadow;  ///< of what the camera sees
  bool is_mirror_in_wave;
};

template <std::size_t W>
struct Surface {
  LaneMask<W> hit;
  Triple<Lanes<W>> point;
  Triple<Lanes<W>> normal;  ///< unit, against the ray
  Lanes<W> near;            ///< of the rays that leave it
  std::uint32_t material[W];
};

/// What the shading needs of the lanes' materials.
template <std::size_t W>
struct Materials {
  Triple<Lanes<W>> ambient, diffuse;
  Lanes<W> specular, shininess, reflection;
};

class Painter {
 public:
  Painter(const Scene& scene, const render::CameraRays& camera) : scene_(scene) {
    const auto to_float = [](const render::Vec3& v) {
      return Triple<float>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    // Both are linear in the pixel's place.
    const render::Ray corner = camera.through(0.5, 0.5);
    const render::Ray right = camera.through(1.5, 0.5);
    const render::Ray below = camera.through(0.5, 1.5);
    origin_ = to_float(corner.origin);
    origin_x_ = to_float(right.origin - corner.origin);
    origin_y_ = to_float(below.origin - corner.origin);
    direction_ = to_float(corner.direction);
    direction_x_ = to_float(right.direction - corner.direction);
    direction_y_ = to_float(below.direction - corner.direction);
    rtcInitIntersectContext(&incoherent_);
    rtcInitIntersectContext(&coherent_);
    coherent_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }

  template <std::size_t W>
  Rays<W> camera_rays(const Lanes<W>& x, const Lanes<W>& y) const {
    return {broadcast<W>(origin_) + x * broadcast<W>(origin_x_) + y * broadcast<W>(origin_y_),
            normalized(broadcast<W>(direction_) + x * broadcast<W>(direction_x_) + y * broadcast<W>(direction_y_)), 0,
            kInfinity};
  }

  template <Hands hands, std::size_t W>
  Triple<Lanes<W>> radiance(Rays<W> rays, LaneMask<W> active, Lanes<W> weight, std::uint32_t bounce);

  render::RayCounts counts;

 private:
  template <Hand hand, std::size_t W>
  Surface<W> nearest(const Rays<W>& rays, const LaneMask<W>& active);
  template <Hand hand, std::size_t W>
  Triple<Lanes<W>> local(const Surface<W>& surface, const Materials<W>& material, const Triple<Lanes<W>>& direction);
  template <std::size_t W>
  Materials<W> gather(const Surface<W>& surface) const;
  template <std::size_t W>
  LaneMask<W> is_behind_plane(const Rays<W>& rays) const;

  const Scene& scene_;
  Triple<float> origin_, origin_x_, origin_y_;
  Triple<float> direction_, direction_x_, direction_y_;
  RTCIntersectContext incoherent_;
  RTCIntersectContext coherent_;
};

template <std::size_t W>
std::uint64_t count_of(const LaneMask<W>& mask) {
  return static_cast<std::uint64_t>(stdx::popcount(mask));
}

template <std::size_t W>
Lanes<W> distance_to(const FloatPlane& plane, const Rays<W>& rays) {
  const auto normal = broadcast<W>(plane.normal);
  return (plane.offset - dot(normal, rays.origin)) / dot(normal, rays.direction);
}

template <Hand hand, std::size_t W>
Surface<W> Painter::nearest(const Rays<W>& asked, const LaneMask<W>& active) {
  using F = Lanes<W>;
  // Find the planes first: they shorten the way through the tree.
  Rays<W> rays = asked;
  F plane_index = -1;
  for (std::size_t i = 0; i != scene_.planes.size(); ++i) {
    const F t = distance_to(scene_.planes[i], rays);
    const auto nearer = t > rays.near && t < rays.far;
    where(nearer, rays.far) = t;
    where(nearer, plane_index) = static_cast<float>(i);
  }
  TreeHits<W> hits{};
  intersect<hand>(scene_.tree.get(), hand == Hand::packet ? coherent_ : incoherent_, rays, active, hits);

  Surface<W> surface;
  F radius = 0;
  F center_x = 0, center_y = 0, center_z = 0;
  LaneMask<W> is_sphere(false);
  for (std::size_t i = 0; i != W; ++i) {
    surface.material[i] = 0;
    if (!active[i]) continue;
    if (hits.sphere[i] != RTC_INVALID_GEOMETRY_ID) {
      const FloatSphere& sphere = scene_.spheres[hits.sphere[i]];
      is_sphere[i] = true;
      center_x[i] = sphere.x;
      center_y[i] = sphere.y;
      center_z[i] = sphere.z;
      radius[i] = sphere.radius;
      surface.material[i] = scene_.sphere_materials[hits.sphere[i]];
    } else if (plane_index[i] >= 0) {
      surface.material[i] = scene_.planes[static_cast<std::size_t>(static_cast<float>(plane_index[i]))].material;
    }
  }
  surface.hit = active && (is_sphere || plane_index >= 0.0F);

  // A point on a sphere is best taken from the sphere: the way along the ray costs digits.
  constexpr stdx::vector_aligned_tag kAligned;
  surface.normal =
      normalized(Triple<F>{F(hits.normal_x, kAligned), F(hits.normal_y, kAligned), F(hits.normal_z, kAligned)});
  surface.point = Triple<F>{center_x, center_y, center_z} + radius * surface.normal;
  if (!scene_.planes.empty()) {
    const Triple<F> on_plane = rays.origin + rays.far * rays.direction;
    for (std::size_t i = 0; i != W; ++i) {
      if (is_sphere[i] || !(plane_index[i] >= 0)) continue;
      const FloatPlane& plane = scene_.planes[static_cast<std::size_t>(static_cast<float>(plane_index[i]))];
      surface.normal.x[i] = plane.normal.x;
      surface.normal.y[i] = plane.normal.y;
      surface.normal.z[i] = plane.normal.z;
    }
    where(!is_sphere, surface.point.x) = on_plane.x;
    where(!is_sphere, surface.point.y) = on_plane.y;
    where(!is_sphere, surface.point.z) = on_plane.z;
    where(!is_sphere, radius) = rays.far;
  }
  const auto from_behind = dot(surface.normal, rays.direction) > 0.0F;
  where(from_behind, surface.normal.x) = -surface.normal.x;
  where(from_behind, surface.normal.y) = -surface.normal.y;
  where(from_behind, surface.normal.z) = -surface.normal.z;
  using std::abs;
  const F largest = stdx::max(stdx::max(abs(surface.point.x), abs(surface.point.y)), abs(surface.point.z));
  surface.near = kOwnSurface * stdx::max(largest, radius);
  return surface;
}

template <std::size_t W>
Materials<W> Painter::gather(const Surface<W>& surface) const {
  Materials<W> m;
  for (std::size_t i = 0; i != W; ++i) {
    const FloatMaterial& material = scene_.materials[surface.material[i]];
    m.ambient.x[i] = material.ambient.x;
    m.ambient.y[i] = material.ambient.y;
    m.ambient.z[i] = material.ambient.z;
    m.diffuse.x[i] = material.diffuse.x;
    m.diffuse.y[i] = material.diffuse.y;
    m.diffuse.z[i] = material.diffuse.z;
    m.specular[i] = material.specular;
    m.shininess[i] = material.shininess;
    m.reflection[i] = material.reflection;
  }
  return m;
}

template <std::size_t W>
LaneMask<W> Painter::is_behind_plane(const Rays<W>& rays) const {
  LaneMask<W> behind(false);
  for (const FloatPlane& plane : scene_.planes) {
    const Lanes<W> t = distance_to(plane, rays);
    behind = behind || (t > rays.near && t < rays.far);
  }
  return behind;
}

/// Ambient light and every light that reaches the surface.
template <Hand hand, std::size_t W>
Triple<Lanes<W>> Painter::local(const Surface<W>& surface, const Materials<W>& material,
                                const Triple<Lanes<W>>& direction) {
  using F = Lanes<W>;
  Triple<F> sum = material.ambient;
  for (const FloatLight& light : scene_.lights) {
    Rays<W> rays{surface.point, broadcast<W>(light.vector), surface.near, kInfinity};
    if (light.is_point) {
      const Triple<F> reach = broadcast<W>(light.vector) - surface.point;
      using std::sqrt;
      rays.far = sqrt(dot(reach, reach));
      rays.direction = (1.0F / rays.far) * reach;
    }
    const F n_l = dot(surface.normal, rays.direction);
    auto lit = surface.hit && n_l > 0.0F;
    if (!scene_.planes.empty()) lit = lit && !is_behind_plane(rays);
    if (stdx::none_of(lit)) continue;
    counts.shadow += count_of<W>(lit);
    lit = lit && !occluded<hand>(scene_.tree.get(), hand == Hand::packet ? coherent_ : incoherent_, rays, lit);
    if (stdx::none_of(lit)) continue;

    const F cosine = dot(rays.direction, direction) - 2.0F * n_l * dot(surface.normal, direction);
    const F base = masked(cosine > 0.0F, stdx::min(cosine, F(1)));
    F highlight;
    if (scene_.has_whole_shininess) {
      highlight = whole_power(base, material.shininess);
    } else {
      for (std::size_t i = 0; i != W; ++i) highlight[i] = std::pow(float(base[i]), float(material.shininess[i]));
    }
    highlight = masked(lit && cosine > 0.0F, material.specular * highlight);
    const Triple<F> color = masked(lit, n_l) * material.diffuse + Triple<F>{highlight, highlight, highlight};
    sum += broadcast<W>(light.color) * color;
  }
  return sum;
}

template <Hands hands, std::size_t W>
Triple<Lanes<W>> Painter::radiance(Rays<W> rays, LaneMask<W> active, Lanes<W> weight, std::uint32_t bounce) {
  using F = Lanes<W>;
  Triple<F> sum;
  for (;; ++bounce) {
    const Surface<W> surface = nearest<hands.camera>(rays, active);
    sum += masked(active && !surface.hit, weight) * broadcast<W>(scene_.background);
    active = surface.hit;
    if (stdx::none_of(active)) return sum;
    const Materials<W> material = gather(surface);
    sum +=
        masked(active, weight * (1.0F - material.reflection)) * local<hands.shadow>(surface, material, rays.direction);
    weight *= material.reflection;
    active = active && weight > 0.0F;
    if (stdx::none_of(active)) return sum;
    if (bounce == scene_.max_bounces) return sum + masked(active, weight) * broadcast<W>(scene_.background);

    counts.mirror += count_of<W>(active);
    const F slope = 2.0F * dot(surface.normal, rays.direction);
    rays = {surface.point, rays.direction - slope * surface.normal, surface.near, kInfinity};
    if constexpr (W > 1) {
      // What a mirror scatters goes on alone.
      if (!hands.is_mirror_in_wave) {
        for (std::size_t i = 0; i != W; ++i) {
          if (!active[i]) continue;
          const auto lane = [i](const Triple<F>& v) { return Triple<Lanes<1>>{v.x[i], v.y[i], v.z[i]}; };
          const auto more = radiance<Hands{Hand::one_by_one, Hand::one_by_one, true}, 1>(
              {lane(rays.origin), lane(rays.direction), rays.near[i], kInfinity}, LaneMask<1>(true),
              Lanes<1>(float(weight[i])), bounce + 1);
          sum.x[i] += more.x[0];
          sum.y[i] += more.y[0];
          sum.z[i] += more.z[0];
        }
        return sum;
      }
    }
  }
}

/// Blocks of pixels, each one wave, in tiles that stay in the caches.
template <std::size_t W, Hands hands>
void paint(Painter& painter, Picture& picture, std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t kTile = 16;
  constexpr std::uint32_t kBlockWidth = W == 1 ? 1 : 4;
  constexpr std::uint32_t kBlockHeight = W / kBlockWidth;
  const auto paint_block = [&](std::uint32_t x0, std::uint32_t y0) {
    Lanes<W> x;
    Lanes<W> y;
    for (std::uint32_t i = 0; i != W; ++i) {
      x[i] = static_cast<float>(x0 + i % kBlockWidth);
      y[i] = static_cast<float>(y0 + i / kBlockWidth);
    }
    const auto active = x < static_cast<float>(width) && y < static_cast<float>(height);
    painter.counts.primary += count_of<W>(active);
    const auto color = painter.radiance<hands, W>(painter.camera_rays<W>(x, y), active, 1, 0);
    for (std::uint32_t i = 0; i != W; ++i) {
      if (!active[i]) continue;
      const std::uint64_t row = y0 + i / kBlockWidth;
      picture.pixels[row * width + x0 + i % kBlockWidth] = {color.x[i], color.y[i], color.z[i]};
    }
  };
  for (std::uint32_t top = 0; top < height; top += kTile) {
    for (std::uint32_t left = 0; left < width; left += kTile) {
      for (std::uint32_t y = top; y < std::min(top + kTile, height); y += kBlockHeight) {
        for (std::uint32_t x = left; x < std::min(left + kTile, width); x += kBlockWidth) paint_block(x, y);
      }
    }
  }
  picture.rays = painter.counts;
}

}  // namespace

Picture draw(const Scene& scene, const render::CameraRays& camera, std::uint32_t width, std::uint32_t height,
             Mode mode) {
  constexpr unsigned kFlushToZero = 0x8000;
  constexpr unsigned kDenormalsAreZero = 0x0040;
  _mm_setcsr(_mm_getcsr() | kFlushToZero | kDenormalsAreZero);  // as Embree's manual advises
  Picture picture;
  picture.pixels.resize(std::size_t{width} * height);
  Painter painter(scene, camera);
  if (mode == Mode::single) {
    paint<1, Hands{Hand::one_by_one, Hand::one_by_one, true}>(painter, picture, width, height);
  } else {
    paint<8, Hands{Hand::packet, Hand::packet, false}>(painter, picture, width, height);
  }
  return picture;
}

}  // namespace tessera::embree
