// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/box.h"
#include "render/ray.h"
#include "render/scene_data.h"

// From a place on the picture to a ray.
namespace tessera::render {

/// Turns picture coordinates into camera rays.
class CameraRays {
 public:
  /// requires: problem_with(camera) has none
  CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height);

  /// The ray through (x, y) of the picture: (0, 0) is its top left corner, pixel (i, j) has its centre at
  /// (i + 0.5, j + 0.5). Orthographic rays start on the plane through the eye.
  Ray through(double x, double y) const noexcept;

  Projection projection() const noexcept { return projection_; }

  // A perspective ray's direction is forward + across(x) right + along(y) down, the first of length 1 and all of them
  // perpendicular to each other.
  const Vec3& eye() const noexcept { return eye_; }
  const Vec3& forward() const noexcept { return forward_; }
  const Vec3& right() const noexcept { return right_; }
  const Vec3& down() const noexcept { return down_; }
  /// In half pixels from the middle of the picture.
  double across(double x) const noexcept { return 2 * x - width_; }
  double along(double y) const noexcept { return 2 * y - height_; }

 private:
  Projection projection_;
  Vec3 eye_;
  Vec3 forward_;
  Vec3 right_;  ///< half a pixel to the right, on the picture plane at distance 1 or through the eye
  Vec3 down_;   ///< half a pixel down
  double width_;
  double height_;
};

/// The direction from which a scene without a camera is seen: from the front, right and above.
inline constexpr Vec3 kDefaultEyeDirection{1, -2, 1};

/// A camera with the whole of `bounds` just inside the picture: eye in kDefaultEyeDirection from the centre, z up,
/// fov 35 degrees. Bounds that are next to a point are seen from a distance of 1.
Camera framed_camera(const Box& bounds, std::uint32_t width, std::uint32_t height);

/// The box of all spheres; where there are none, a unit box around the first plane's point or the origin.
Box bounds_of(const SceneData& scene);

}  // namespace tessera::render
