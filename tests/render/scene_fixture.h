// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "render/intersect.h"
#include "render/tile_renderer.h"
#include "render/tracer.h"

// Short ways to say a scene, and to ask it one question.
namespace tessera::render::test {

inline constexpr Rgb kWhite{1, 1, 1};
inline constexpr double kPi = 3.14159265358979323846;

/// Shows `color` and nothing else: its own term is the ambient one, with weight 1.
inline Material glowing(const Rgb& color, double reflection = 0) {
  return {.color = color, .ambient = 1, .diffuse = 0, .specular = 0, .shininess = 32, .reflection = reflection};
}
/// Shows `color` times the sum of I N.L.
inline Material matte(const Rgb& color = kWhite) {
  return {.color = color, .ambient = 0, .diffuse = 1, .specular = 0, .shininess = 32, .reflection = 0};
}
inline Material mirror(double reflection = 1) {
  return glowing({0, 0, 0}, reflection);
}

inline MaterialIndex add_material(SceneData& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<MaterialIndex>(scene.materials.size() - 1);
}
inline void add_sphere(SceneData& scene, const Vec3& center, double radius, const Material& material = matte()) {
  scene.spheres.push_back({center, radius, add_material(scene, material)});
}
inline void add_plane(SceneData& scene, const Vec3& point, const Vec3& normal, const Material& material = matte()) {
  scene.planes.push_back({point, normal, add_material(scene, material), std::nullopt});
}
inline void add_point_light(SceneData& scene, const Vec3& position, const Rgb& color = kWhite) {
  scene.lights.push_back({LightKind::point, position, color});
}
inline void add_directional_light(SceneData& scene, const Vec3& direction, const Rgb& color = kWhite) {
  scene.lights.push_back({LightKind::directional, direction, color});
}

inline Region region_at(const Scene& scene, const Vec3& eye, const Vec3& direction) {
  return Region(scene, scene.placement_of(eye), eye, direction);
}
inline std::optional<Hit> hit_from(const Scene& scene, const Vec3& eye, const Vec3& direction) {
  return nearest_hit(scene, Ray{.origin = eye, .direction = direction}, region_at(scene, eye, direction));
}

/// What an eye sees along a ray, with the bounces and the shade of the scene's image settings.
inline Rgb seen_from(const Scene& scene, const Vec3& eye, const Vec3& direction, RayCounts& counts,
                     std::span<PathObserver* const> observers = {}) {
  const TraceOptions options{scene.data().image.max_bounces, scene.data().image.shade};
  const Ray ray{.origin = eye, .direction = direction};
  return radiance_along(scene, ray, region_at(scene, eye, direction), options, counts, observers);
}
inline Rgb seen_from(const Scene& scene, const Vec3& eye, const Vec3& direction) {
  RayCounts counts;
  return seen_from(scene, eye, direction, counts);
}
inline Rgb seen_from(SceneData scene, const Vec3& eye, const Vec3& direction) {
  return seen_from(Scene(std::move(scene), Kernel::automatic), eye, direction);
}

/// The pixels of one rectangle of a scene's picture.
inline Image render_rect(const Scene& scene, const Rect& rect, PixelFormat format) {
  Image image(rect.width, rect.height, format);
  TileRenderer(scene, format).render(rect, {image.bytes}, [] {});
  return image;
}
inline Image render_picture(const Scene& scene, PixelFormat format) {
  return render_rect(scene, {0, 0, scene.data().image.width, scene.data().image.height}, format);
}

}  // namespace tessera::render::test
