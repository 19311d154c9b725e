// SPDX-License-Identifier: BSD-3-Clause
// Paths followed together against paths followed one by one: the same radiances, bit for bit, and as many rays.
#include "render/wavefront.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "render/camera_paths.h"
#include "render/encode.h"
#include "render/kernels.h"
#include "render/same_bits.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr std::uint32_t kBounces[] = {0, 1, 20};

/// Spheres that mirror nothing, something and everything above a checkered floor that mirrors a little, and a wall.
SceneData mirror_scene(std::size_t lights) {
  SceneData data;
  Random random(91);
  for (int i = 0; i != 24; ++i) {
    Material material = i % 4 == 3 ? glowing({0.2, 0.7, 0.4}) : matte({0.9, 0.5, 0.02 * i});
    material.ambient = 0.1;
    material.specular = i % 2 == 0 ? 0.5 : 0;
    material.reflection = i % 3 == 0 ? 0 : i % 3 == 1 ? 0.3 : 1;
    add_sphere(data, random.in_box(2), random.uniform(0.2, 0.7), material);
  }
  add_plane(data, {0, 0, -3}, {0, 0.1, 1}, {.reflection = 0.3});
  data.planes[0].checker = Checker{MaterialIndex{1}, 0.7};
  add_plane(data, {0, 5, 0}, {0, -1, 0}, mirror());
  for (std::size_t i = 0; i != lights; ++i) {
    const Rgb color{random.uniform(), random.uniform(), random.uniform()};
    if (i == 0) {
      // In the very plane of the floor, so that rounding puts it above half of its points.
      add_point_light(data, data.planes[0].point, color);
    } else if (i % 3 == 1) {
      add_directional_light(data, random.direction(), color);
    } else {
      add_point_light(data, 4 * random.direction(), color);
    }
  }
  data.environment.background = {0.1, 0.2, 0.3};
  data.environment.ambient = {0.9, 1, 1.1};
  data.camera = Camera{.eye = {-3, -6, 2}, .target = {0, 0, 0}, .fov = 50};
  data.camera->height = 6;
  return data;
}

/// Paths from eyes anywhere: also in spheres, and on them.
CameraPaths paths_through(const Scene& scene, const Vec3& center, double size, int count) {
  CameraPaths paths;
  Random random(92);
  for (int i = 0; i != count; ++i) {
    const auto spheres = scene.spheres();
    const Sphere& aim = spheres[random.below(static_cast<std::uint32_t>(spheres.size()))];
    const Vec3 target = aim.center + random.in_box(1.2 * aim.radius);
    Vec3 eye = center + random.in_box(3 * size);
    if (i % 4 == 1) eye = aim.center + random.in_box(0.5 * aim.radius);
    if (i % 4 == 2) eye = aim.center + Vec3{aim.radius, 0, 0};
    paths.add(scene, eye, target == eye ? Vec3{0, 0, 1} : target - eye);
  }
  return paths;
}

/// Follows paths both ways; `wavefront` may have followed others before.
void check_paths(const Scene& scene, std::span<const RayInRegion> rays, const TraceOptions& options,
                 Wavefront& wavefront, const std::string& what) {
  std::vector<Rgb> together(rays.size(), {7, 7, 7});
  RayCounts counts{.primary = 1, .shadow = 2, .mirror = 3};
  RayCounts expected_counts = counts;
  wavefront.trace(rays, together, counts, [] {});
  int differences = 0;
  for (std::size_t i = 0; i != rays.size(); ++i) {
    const Rgb alone = radiance_along(scene, rays[i].ray, *rays[i].region, options, expected_counts);
    differences += !same_bits(alone, together[i]);
  }
  BOOST_TEST(differences == 0, what << ": " << differences << " of " << rays.size() << " radiances differ");
  BOOST_TEST((counts == expected_counts), what);
}

/// A tile as its pixels are defined, one after the other.
Image tile_pixel_by_pixel(const Scene& scene, const Rect& tile, RayCounts& counts) {
  const Stage& data = scene.data();
  const CameraRays camera(*data.camera, data.image.width, data.image.height);
  const auto grid = static_cast<std::uint32_t>(std::lround(std::sqrt(data.image.samples)));
  Image image(tile.width, tile.height, PixelFormat::rgb32f);
  for (std::uint32_t i = 0; i != tile.width * tile.height; ++i) {
    Rgb sum;
    for (std::uint32_t s = 0; s != grid * grid; ++s) {
      const Ray ray = camera.through(tile.x + i % tile.width + (s % grid + 0.5) / grid,
                                     tile.y + i / tile.width + (s / grid + 0.5) / grid);
      sum += seen_from(scene, ray.origin, ray.direction, counts);
    }
    const Rgb mean = sum * (1 / (static_cast<double>(grid) * grid));
    encode_pixel(mean, image.format, data.image.transfer, image.bytes.data() + i * bytes_per_pixel(image.format));
  }
  return image;
}

void check_tile(const Scene& scene, const Rect& tile) {
  RayCounts expected_counts;
  const Image expected = tile_pixel_by_pixel(scene, tile, expected_counts);
  Image image(tile.width, tile.height, PixelFormat::rgb32f);
  const RayCounts counts = TileRenderer(scene, image.format).render(tile, {image.bytes}, [] {});
  BOOST_TEST((image.bytes == expected.bytes), tile.width << "x" << tile.height);
  BOOST_TEST((counts == expected_counts), tile.width << "x" << tile.height);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(wavefront)

BOOST_AUTO_TEST_CASE(paths_together_are_paths_alone_in_every_kind_of_scene) {
  for (const SceneKind& kind : scene_kinds()) {
    for (const auto& [kernel, name] : supported_kernels()) {
      const Scene scene(random_scene(kind, 91), kernel);
      const CameraPaths paths = paths_through(scene, kind.center, kind.size, 200);
      for (const std::uint32_t bounces : kBounces) {
        const TraceOptions options{bounces, Shade::blinn};
        Wavefront wavefront(scene, options);
        check_paths(scene, paths.rays, options, wavefront, kind.name + ", " + name);
      }
    }
  }
}

// From no light to more than a batch has rays; the same wavefront for batches of falling and rising size.
BOOST_AUTO_TEST_CASE(paths_together_are_paths_alone_under_any_number_of_lights) {
  for (const std::size_t lights : {0U, 1U, 40U}) {
    for (const auto& [kernel, name] : supported_kernels()) {
      const Scene scene(mirror_scene(lights), kernel);
      const CameraPaths paths = paths_through(scene, {0, 0, 0}, 2, 100);
      for (const std::uint32_t bounces : kBounces) {
        const TraceOptions options{bounces, Shade::phong};
        Wavefront wavefront(scene, options);
        for (const std::size_t size : {100U, 0U, 1U, 33U}) {
          check_paths(scene, std::span(paths.rays).first(size), options, wavefront,
                      std::to_string(lights) + " lights, " + name);
        }
      }
    }
  }
}

// Its weight is 1 to the end, so is its number of mirror rays: n, and the background in place of the next.
BOOST_AUTO_TEST_CASE(path_between_two_perfect_mirrors_takes_every_bounce) {
  SceneData data;
  add_plane(data, {0, 0, 0}, {0, 0, 1}, mirror());
  add_plane(data, {0, 0, 1}, {0, 0, 1}, mirror());
  data.environment.background = {0.25, 0.5, 1};
  for (const auto& [kernel, name] : supported_kernels()) {
    const Scene scene(data, kernel);
    CameraPaths paths;
    paths.add(scene, {0, 0, 0.5}, {0, 0, 2});
    Rgb radiance[1];
    RayCounts counts;
    Wavefront(scene, {1000, Shade::phong}).trace(paths.rays, radiance, counts, [] {});
    BOOST_TEST((counts == RayCounts{.primary = 1, .shadow = 0, .mirror = 1000}), name);
    BOOST_TEST((radiance[0] == Rgb{0.25, 0.5, 1}), name);
  }
}

// One after the camera rays, and one after each batch of rays to a light, if there is any.
BOOST_AUTO_TEST_CASE(wavefront_pauses_after_steps_that_took_rays) {
  SceneData data;
  add_sphere(data, {0, 0, 0}, 1);
  for (const double z : {5.0, -5.0, 6.0}) add_point_light(data, {0, 0, z});
  for (const auto& [kernel, name] : supported_kernels()) {
    const Scene scene(data, kernel);
    for (const bool hits : {false, true}) {
      CameraPaths paths;
      paths.add(scene, {0, 0, 4}, {0, hits ? 0.0 : 1.0, -1});
      Rgb radiance[1];
      RayCounts counts;
      int pauses = 0;
      Wavefront(scene, {}).trace(paths.rays, radiance, counts, [&] { ++pauses; });
      BOOST_TEST(pauses == (hits ? 3 : 1), name);
    }
  }
}

BOOST_AUTO_TEST_CASE(tiles_hold_the_pixels_that_are_traced_one_by_one) {
  for (const auto& [kernel, name] : supported_kernels()) {
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
      for (const std::uint32_t samples : {1U, 4U, 9U}) {
        SceneData data = mirror_scene(3);
        data.camera->projection = projection;
        data.image.width = 310;
        data.image.height = 60;
        data.image.samples = samples;
        data.image.max_bounces = 3;
        const Scene scene(data, kernel);
        BOOST_TEST_CONTEXT(name << ", " << samples << " samples, orthographic: " << static_cast<int>(projection)) {
          check_tile(scene, {150, 30, 1, 1});
          check_tile(scene, {140, 23, 7, 5});
          check_tile(scene, {5, 31, 300, 1});
          if (samples != 9) check_tile(scene, {130, 20, 40, 33});
        }
      }
    }
  }
}

// From a point on a sphere, half of the rays of one tile begin inside of it and half outside.
BOOST_AUTO_TEST_CASE(tiles_seen_from_a_surface_hold_the_pixels_that_are_traced_one_by_one) {
  SceneData data = mirror_scene(3);
  add_sphere(data, {-3, 2, 2}, 8, matte());
  data.camera->fov = 120;
  data.image.width = 40;
  data.image.height = 33;
  data.image.samples = 4;
  for (const Vec3& target : {Vec3{0, 0, 0}, Vec3{0, -6, 2}, Vec3{-3, -7, 2}}) {
    data.camera->target = target;
    for (const auto& [kernel, name] : supported_kernels()) {
      const Scene scene(data, kernel);
      BOOST_TEST_REQUIRE(scene.placement_of(data.camera->eye).touching.size() == 1U);
      BOOST_TEST_CONTEXT(name) check_tile(scene, {0, 0, 40, 33});
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
