// SPDX-License-Identifier: BSD-3-Clause
#include "render/camera.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/check.h"
#include "render/random.h"
#include "render/scene_fixture.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

/// The camera's axes by their definition: right = forward x up, no code shared with CameraRays.
struct Axes {
  Vec3 forward;
  Vec3 right;
  Vec3 up;

  explicit Axes(const Camera& camera)
      : forward(normalized(camera.target - camera.eye)),
        right(normalized(cross(forward, camera.up))),
        up(cross(right, forward)) {}
};

double tangent(const Camera& camera) {
  return std::tan(camera.fov * kPi / 360);
}

double distance(const Vec3& a, const Vec3& b) {
  return length(a - b);
}

Camera random_camera(Random& random) {
  Camera camera;
  camera.eye = random.in_box(10);
  camera.target = camera.eye + random.over_decades(0.01, 100) * random.direction();
  camera.up = random.over_decades(0.01, 100) * random.direction();
  camera.fov = random.uniform(1, 170);
  camera.height = random.over_decades(0.01, 100);
  return camera;
}

/// How far the box reaches in a picture: 1 is the edge, of width or height, whichever is nearer.
double reach_of(const Camera& camera, const Box& box, double width, double height) {
  const Axes axes(camera);
  double reach = 0;
  for (int corner = 0; corner != 8; ++corner) {
    const Vec3 p =
        Vec3{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z} -
        camera.eye;
    const double depth = dot(p, axes.forward) * tangent(camera);
    BOOST_REQUIRE(depth > 0);
    reach = std::max({reach, std::abs(dot(p, axes.up)) / depth, std::abs(dot(p, axes.right)) / depth * height / width});
  }
  return reach;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(camera)

// One pixel, its centre: straight ahead.
BOOST_AUTO_TEST_CASE(middle_of_the_picture_looks_at_the_target) {
  Random random(91);
  for (int i = 0; i != 100; ++i) {
    const Camera camera = random_camera(random);
    const Ray ray = CameraRays(camera, 7, 5).through(3.5, 2.5);
    BOOST_TEST(distance(normalized(ray.direction), Axes(camera).forward) <= 1e-14);
    BOOST_TEST((ray.origin == camera.eye && ray.from == SurfaceId::none));
  }
}

// Eye in -y looking along y, z up, fov 90: the picture spans x, z in [-1, 1] at distance 1; row 0 is on top.
BOOST_AUTO_TEST_CASE(right_of_the_picture_is_right_in_the_world_and_row_zero_is_on_top) {
  const CameraRays rays({.eye = {0, -2, 0}, .target = {0, 5, 0}, .up = {0, 0, 9}, .fov = 90}, 4, 4);
  const auto slope = [&](double x, double y) {
    const Vec3 d = rays.through(x, y).direction;
    return Vec3{d.x / d.y, 1, d.z / d.y};
  };
  BOOST_TEST(distance(slope(0, 0), {-1, 1, 1}) <= 1e-15);
  BOOST_TEST(distance(slope(4, 4), {1, 1, -1}) <= 1e-15);
  BOOST_TEST(distance(slope(2.5, 0.5), {0.25, 1, 0.75}) <= 1e-15);
}

// forward + tan(fov / 2) ((2x - w) / h right + (h - 2y) / h up)
BOOST_AUTO_TEST_CASE(perspective_rays_follow_the_pinhole_formula) {
  Random random(92);
  double worst = 0;
  for (int i = 0; i != 2000; ++i) {
    const Camera camera = random_camera(random);
    const Axes axes(camera);
    const std::uint32_t w = 1 + random.below(300);
    const std::uint32_t h = 1 + random.below(300);
    const double x = random.uniform(0, w);
    const double y = random.uniform(0, h);
    const Vec3 expected = axes.forward + tangent(camera) / h * ((2 * x - w) * axes.right + (h - 2 * y) * axes.up);
    const Ray ray = CameraRays(camera, w, h).through(x, y);
    const double sine = length(cross(axes.forward, normalized(camera.up)));
    worst = std::max(worst, sine * distance(normalized(ray.direction), normalized(expected)));
  }
  BOOST_TEST_MESSAGE("camera directions: " << worst);
  BOOST_TEST(worst <= 1e-14);
}

// Parallel rays from the plane through the eye, `height` world units from top to bottom.
BOOST_AUTO_TEST_CASE(orthographic_rays_start_on_the_plane_through_the_eye) {
  Random random(93);
  double worst = 0;
  for (int i = 0; i != 2000; ++i) {
    Camera camera = random_camera(random);
    camera.projection = Projection::orthographic;
    const Axes axes(camera);
    const std::uint32_t w = 1 + random.below(300);
    const std::uint32_t h = 1 + random.below(300);
    const double x = random.uniform(0, w);
    const double y = random.uniform(0, h);
    const double pixel = camera.height / h;
    const Vec3 start = camera.eye + pixel * ((x - 0.5 * w) * axes.right + (0.5 * h - y) * axes.up);
    const Ray ray = CameraRays(camera, w, h).through(x, y);
    const double sine = length(cross(axes.forward, normalized(camera.up)));
    worst = std::max(worst, sine * distance(ray.origin, start) / (1 + pixel * w + pixel * h));
    worst = std::max(worst, sine * distance(normalized(ray.direction), axes.forward));
  }
  BOOST_TEST_MESSAGE("orthographic rays: " << worst);
  BOOST_TEST(worst <= 1e-14);
}

// Left-handed: x turns into width - x, to the bit at pixel centres.
BOOST_AUTO_TEST_CASE(left_handed_camera_flips_x_exactly) {
  Random random(94);
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    for (int i = 0; i != 500; ++i) {
      Camera camera = random_camera(random);
      camera.projection = projection;
      Camera flipped = camera;
      flipped.handedness = Handedness::left;
      const std::uint32_t w = 1 + random.below(1000);
      const double x = random.below(w) + 0.5;
      const double y = random.below(100) + 0.5;
      const Ray a = CameraRays(camera, w, 100).through(x, y);
      const Ray b = CameraRays(flipped, w, 100).through(w - x, y);
      BOOST_TEST((a.origin == b.origin && a.direction == b.direction));
    }
  }
}

// Every corner inside the picture, and at least one on its edge, to 1e-12.
BOOST_AUTO_TEST_CASE(framed_camera_shows_the_whole_box_and_no_more) {
  Random random(95);
  for (int i = 0; i != 500; ++i) {
    const Vec3 center = random.in_box(random.over_decades(0.1, 100));
    const Vec3 half = random.over_decades(1e-3, 1e3) * Vec3{random.uniform(), random.uniform(), random.uniform()};
    const Box box{center - half, center + half};
    const std::uint32_t w = 1 + random.below(2000);
    const std::uint32_t h = 1 + random.below(2000);
    const Camera camera = framed_camera(box, w, h);
    const double blur = 1e-12 + 1e-14 * length(center) / length(half);
    BOOST_TEST(std::abs(reach_of(camera, box, w, h) - 1) <= blur);
  }
}

BOOST_AUTO_TEST_CASE(framed_camera_stands_in_front_to_the_right_and_above) {
  const Box box{{-1, 2, 3}, {3, 4, 9}};
  const Camera camera = framed_camera(box, 640, 480);
  BOOST_TEST(camera.fov == 35);
  BOOST_TEST((camera.projection == Projection::perspective && camera.handedness == Handedness::right));
  const Vec3 from_center = camera.eye - Vec3{1, 3, 6};
  BOOST_TEST(distance(normalized(from_center), normalized(kDefaultEyeDirection)) <= 1e-14);
  BOOST_TEST(distance(normalized(camera.target - camera.eye), normalized(-from_center)) <= 1e-14);
  BOOST_TEST(dot(cross(camera.up, camera.eye - camera.target), {2, 1, 0}) > 0, "z is up in the picture");
}

// Spheres of radius 1 at x = -3 and of radius 2 at z = 5, and what rounding adds.
BOOST_AUTO_TEST_CASE(bounds_hold_all_spheres) {
  SceneData scene;
  add_sphere(scene, {-3, 0, 0}, 1);
  add_sphere(scene, {0, 0, 5}, 2);
  const Box box = bounds_of(scene);
  BOOST_TEST(distance(box.lo, {-4, -2, -1}) <= 1e-13);
  BOOST_TEST(distance(box.hi, {2, 2, 7}) <= 1e-13);
}

BOOST_AUTO_TEST_CASE(bounds_without_spheres_are_a_unit_box) {
  SceneData scene;
  BOOST_TEST(distance(bounds_of(scene).lo + bounds_of(scene).hi, {0, 0, 0}) <= 1e-15);
  BOOST_TEST(distance(bounds_of(scene).hi - bounds_of(scene).lo, {1, 1, 1}) <= 1e-15);
  add_plane(scene, {5, 6, 7}, {1, 0, 0});
  BOOST_TEST(distance(0.5 * (bounds_of(scene).lo + bounds_of(scene).hi), {5, 6, 7}) <= 1e-14);
}

// Bounds without extent, or lost in the rounding of a far centre, must not put the eye on the target.
BOOST_AUTO_TEST_CASE(framed_camera_of_next_to_nothing_can_be_rendered) {
  for (const Vec3& center : {Vec3{0, 0, 0}, Vec3{1, 2, 3}, Vec3{1e6, 0, -1e6}}) {
    for (const double radius : {0.0, 1e-12}) {
      SceneData scene;
      add_sphere(scene, center, radius);
      BOOST_TEST(problem_with(framed_camera(bounds_of(scene), 10, 10)).value_or("") == "");
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
