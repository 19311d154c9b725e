// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "render/camera.h"
#include "render/exact.h"
#include "render/quad_oracle.h"
#include "render/random.h"
#include "render/reference/quad_tracer.h"
#include "render/scale.h"
#include "render/scene_fixture.h"
#include "stress/verdict.h"

// What the cases of the stress matrix share: scenes brought to unit scale as the program does, pictures in double
// precision, and the comparison with quad precision ray by ray.
namespace tessera::stress {

using namespace tessera::render;
using namespace tessera::render::test;

inline Scene prepared(const SceneData& data, Kernel kernel = Kernel::automatic) {
  return Scene(unit_scaled(data), kernel);
}

/// A whole number from the environment, 1 or more, or `otherwise`.
inline int whole_number_of(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::max(1, std::atoi(text)) : otherwise;
}

/// `count` times TESSERA_STRESS_SCALE, 1 where it is not set.
inline int scaled_count(int count) {
  return count * whole_number_of("TESSERA_STRESS_SCALE", 1);
}

/// The seed of a case: another one for each TESSERA_STRESS_PART, so that parts of a long run repeat nothing.
inline std::uint64_t seed_of(int number) {
  return static_cast<std::uint64_t>(number + 1000 * whole_number_of("TESSERA_STRESS_PART", 0));
}

/// The radiances of a small square picture, row by row.
inline std::vector<Rgb> picture_of(const SceneData& data, std::uint32_t side = 32) {
  const Scene scene = prepared(data);
  const CameraRays rays(*scene.data().camera, side, side);
  std::vector<Rgb> picture;
  for (std::uint32_t y = 0; y != side; ++y) {
    for (std::uint32_t x = 0; x != side; ++x) {
      const Ray ray = rays.through(x + 0.5, y + 0.5);
      picture.push_back(seen_from(scene, ray.origin, ray.direction));
    }
  }
  return picture;
}

inline double largest_difference(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  double largest = 0;
  for (std::size_t i = 0; i != a.size(); ++i) {
    for (const double d : {a[i].r - b[i].r, a[i].g - b[i].g, a[i].b - b[i].b}) {
      if (!(std::abs(d) <= largest)) largest = std::abs(d);
    }
  }
  return largest;
}

/// First hits against quad precision: which surface, how far, and the normal.
struct HitCheck {
  explicit HitCheck(const Scene& s) : scene(s) {}

  void trace(const Vec3& eye, const Vec3& direction) {
    const auto hit = hit_from(scene, eye, direction);
    const auto exact = QuadTracer(scene.view(), eye, direction).first_hit();
    ++tried;
    hits += exact.has_value();
    if (hit.has_value() != exact.has_value() || (hit && index_of(hit->surface) != exact->surface)) {
      ++wrong;
    } else if (hit) {
      t = std::max(t, error_of(hit->t, exact->t) / std::max(static_cast<double>(exact->t), 1e-300));
      const Vec3 facing = dot(hit->normal, direction) > 0 ? -hit->normal : hit->normal;
      normal = std::max(normal, error_of(facing, exact->normal));
    }
  }

  /// All rays of a square picture.
  void trace_picture(std::uint32_t side) {
    const CameraRays rays(*scene.data().camera, side, side);
    for (std::uint32_t i = 0; i != side * side; ++i) {
      const Ray ray = rays.through(i % side + 0.5, i / side + 0.5);
      trace(ray.origin, ray.direction);
    }
  }

  const Scene& scene;
  std::size_t tried = 0;
  std::size_t hits = 0;
  std::size_t wrong = 0;
  double t = 0;       ///< largest relative error
  double normal = 0;  ///< largest error
};

/// A few spheres, some of them mirrors, a floor and two lights, all on coordinates of 20 bits, and a camera.
inline SceneData small_scene() {
  SceneData data;
  Random random(7);
  const auto snapped = [&](double lo, double hi) { return std::floor(random.uniform(lo, hi) * 0x1p20) * 0x1p-20; };
  for (int i = 0; i != 12; ++i) {
    Material material{.color = {0.9, 0.5 + 0.03 * i, 0.3}, .specular = 0.4, .shininess = 20};
    material.reflection = i % 3 == 0 ? 0.5 : 0;
    add_sphere(data, {snapped(-2, 2), snapped(-2, 2), snapped(-1, 2)}, snapped(0.2, 0.7), material);
  }
  add_plane(data, {0, 0, -1.5}, {0, 0, 1});
  add_point_light(data, {4, -5, 6}, {0.7, 0.7, 0.7});
  add_point_light(data, {-3.5, -1, 4}, {0.3, 0.2, 0.1});
  data.environment.background = {0.1, 0.2, 0.4};
  data.camera = Camera{.eye = {0.25, -8, 1.5}, .target = {0, 0, 0.125}};
  data.image.max_bounces = 3;
  return data;
}

}  // namespace tessera::stress
