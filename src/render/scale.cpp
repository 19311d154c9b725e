// SPDX-License-Identifier: BSD-3-Clause
#include "render/scale.h"

#include <algorithm>
#include <cmath>

namespace tessera::render {
namespace {

/// Calls visit(length) for every number of a scene that is a length in world units.
template <class Data, class Visit>
void visit_lengths(Data& scene, Visit&& visit) {
  const auto visit_point = [&](auto& p) {
    visit(p.x);
    visit(p.y);
    visit(p.z);
  };
  for (auto& sphere : scene.spheres) {
    visit_point(sphere.center);
    visit(sphere.radius);
  }
  for (auto& plane : scene.planes) {
    visit_point(plane.point);
    if (plane.checker) visit(plane.checker->size);
  }
  for (auto& light : scene.lights) {
    if (light.kind == LightKind::point) visit_point(light.vector);
  }
  if (!scene.camera) return;
  visit_point(scene.camera->eye);
  visit_point(scene.camera->target);
  if (scene.camera->projection == Projection::orthographic) visit(scene.camera->height);
}

void scale_direction(Vec3& v) noexcept {
  int exponent = 0;
  v = rescaled(v, exponent);
}

}  // namespace

double largest_length_of(const SceneData& scene) noexcept {
  double largest = 0;
  visit_lengths(scene, [&](double length) { largest = std::max(largest, std::abs(length)); });
  return largest;
}

SceneData unit_scaled(SceneData scene) {
  int exponent = 0;
  std::frexp(largest_length_of(scene), &exponent);
  visit_lengths(scene, [&](double& length) { length = std::ldexp(length, -exponent); });
  for (Plane& plane : scene.planes) scale_direction(plane.normal);
  for (Light& light : scene.lights) {
    if (light.kind == LightKind::directional) scale_direction(light.vector);
  }
  if (scene.camera) scale_direction(scene.camera->up);
  return scene;
}

}  // namespace tessera::render
