// SPDX-License-Identifier: BSD-3-Clause
#include "render/camera.h"

#include <algorithm>
#include <cmath>

#include "render/power.h"

namespace tessera::render {
namespace {

constexpr double kFramedFov = 35;

double half_height_of(const Camera& camera) {
  return camera.projection == Projection::orthographic ? camera.height / 2 : tangent_of_degrees(camera.fov / 2);
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height)
    : projection_(camera.projection), eye_(camera.eye), width_(width), height_(height) {
  forward_ = normalized(camera.target - camera.eye);
  const Vec3 right = normalized(cross(forward_, camera.up));
  const Vec3 up = cross(right, forward_);
  const double half_pixel = half_height_of(camera) / height_;
  right_ = right * (camera.handedness == Handedness::right ? half_pixel : -half_pixel);
  down_ = up * -half_pixel;
}

Ray CameraRays::through(double x, double y) const noexcept {
  // In half pixels from the middle: exact, and so the same at mirrored places.
  const Vec3 offset = across(x) * right_ + along(y) * down_;
  if (projection_ == Projection::orthographic) return {eye_ + offset, forward_};
  return {eye_, forward_ + offset};
}

Camera framed_camera(const Box& bounds, std::uint32_t width, std::uint32_t height) {
  const Vec3 center = 0.5 * bounds.lo + 0.5 * bounds.hi;
  const Vec3 backward = normalized(kDefaultEyeDirection);
  const Vec3 up{0, 0, 1};
  const Vec3 right = normalized(cross(up, backward));
  const Vec3 screen_up = cross(backward, right);
  const double tan_y = tangent_of_degrees(kFramedFov / 2);
  const double tan_x = tan_y * width / height;

  // Step back until each corner is inside both pairs of the picture's edges.
  double distance = 0;
  for (int corner = 0; corner != 8; ++corner) {
    const Vec3 p = Vec3{(corner & 1) != 0 ? bounds.hi.x : bounds.lo.x, (corner & 2) != 0 ? bounds.hi.y : bounds.lo.y,
                        (corner & 4) != 0 ? bounds.hi.z : bounds.lo.z} -
                   center;
    const double toward = dot(p, backward);
    distance =
        std::max({distance, toward + std::abs(dot(p, right)) / tan_x, toward + std::abs(dot(p, screen_up)) / tan_y});
  }
  constexpr double kNextToNothing = 0x1p-400;
  if (distance < kNextToNothing) distance = 1;
  Camera camera;
  camera.eye = center + distance * backward;
  camera.target = center;
  camera.up = up;
  camera.fov = kFramedFov;
  return camera;
}

Box bounds_of(const SceneData& scene) {
  Box bounds;
  for (const Sphere& sphere : scene.spheres) bounds.include(bounds_of(sphere.center, sphere.radius));
  if (!scene.spheres.empty()) return bounds;
  const Vec3 middle = scene.planes.empty() ? Vec3{} : scene.planes.front().point;
  return {middle - Vec3{0.5, 0.5, 0.5}, middle + Vec3{0.5, 0.5, 0.5}};
}

}  // namespace tessera::render
