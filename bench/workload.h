// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/generate.h"
#include "render/camera.h"
#include "render/intersect.h"
#include "render/stream.h"
#include "render/tile.h"
#include "render/vertex.h"

// Scenes to measure on, and the rays that a picture of them takes.
namespace tessera::bench {

inline std::string name_of(render::Kernel kernel) {
  switch (kernel) {
    case render::Kernel::scalar:
      return "scalar";
    case render::Kernel::avx2:
      return "avx2";
    case render::Kernel::brute:
      return "brute";
    case render::Kernel::automatic:
      break;
  }
  return "auto";
}

/// Those that search a tree and run on this machine.
inline std::vector<render::Kernel> tree_kernels() {
  std::vector<render::Kernel> kernels{render::Kernel::scalar};
  if (is_supported(render::Kernel::avx2)) kernels.push_back(render::Kernel::avx2);
  return kernels;
}

inline std::vector<render::Sphere> cloud_of(std::uint64_t count) {
  return io::generate_cloud({.count = count, .materials = {render::MaterialIndex{0}}});
}

/// 66,430 spheres.
inline std::vector<render::Sphere> flake() {
  return io::generate_sphereflake({.level = 5, .materials = {render::MaterialIndex{0}}});
}

/// Spheres within 1 of the origin, half mirrors, under one light, seen from outside.
inline render::SceneData scene_of(std::vector<render::Sphere> spheres) {
  render::SceneData scene;
  scene.spheres = std::move(spheres);
  scene.materials = {{.specular = 0.4, .reflection = 0.5}};
  scene.lights = {{render::LightKind::point, {4, -3, 5}, {1, 1, 1}}};
  scene.environment.background = {0.1, 0.2, 0.4};
  scene.camera = render::Camera{.eye = {2.5, -4, 2}, .target = {0, 0, 0}, .fov = 30};
  return scene;
}

/// The rays of a picture, in the order in which tiles of 16 pixels take them.
struct PictureRays {
  static constexpr std::uint32_t kSide = 128;

  render::Region region;
  std::vector<render::RayInRegion> camera;  ///< coherent
  std::vector<render::RayInRegion> mirror;  ///< from where those hit, hardly so
  std::vector<render::RayInRegion> camera_shadow;
  std::vector<render::RayInRegion> mirror_shadow;

  explicit PictureRays(const render::Scene& scene) : region(region_of(scene)) {
    const render::CameraRays rays(*scene.data().camera, kSide, kSide);
    for (const render::Rect& tile : render::tile_grid({0, 0, kSide, kSide}, 16, 16)) {
      for (std::uint32_t i = 0; i != tile.pixels(); ++i) {
        camera.push_back({rays.through(tile.x + i % 16 + 0.5, tile.y + i / 16 + 0.5), &region});
      }
    }
    leave(scene, camera, camera_shadow, mirror);
    std::vector<render::RayInRegion> further;
    leave(scene, mirror, mirror_shadow, further);
  }
  PictureRays(const PictureRays&) = delete;

 private:
  static render::Region region_of(const render::Scene& scene) {
    const render::Camera& camera = *scene.data().camera;
    return {scene, scene.placement_of(camera.eye), camera.eye, camera.target - camera.eye};
  }

  /// The rays to the light and to what a mirror shows, from wherever `rays` hit.
  void leave(const render::Scene& scene, const std::vector<render::RayInRegion>& rays,
             std::vector<render::RayInRegion>& shadow, std::vector<render::RayInRegion>& mirrored) const {
    for (const auto& [ray, of_ray] : rays) {
      const auto hit = nearest_hit(scene, ray, region);
      if (!hit) continue;
      const render::Vec3 way = way_to(scene.data().lights[0], hit->point);
      if (dot(hit->normal, way) > 0) shadow.push_back({ray_to_light(*hit, way), &region});
      mirrored.push_back({mirrored_ray(*hit, hit->normal, ray.direction), &region});
    }
  }
};

}  // namespace tessera::bench
