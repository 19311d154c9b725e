// SPDX-License-Identifier: BSD-3-Clause
#include "render/scale.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "render/check.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

SceneData everything() {
  SceneData data;
  add_sphere(data, {1, -3, 2}, 0.5);
  add_plane(data, {0, 0, -5}, {0, 0, 3});
  data.planes[0].checker = Checker{{}, 0.25};
  add_point_light(data, {6, 1, 0});
  add_directional_light(data, {0, -80, 10});
  data.camera = Camera{.eye = {7, 0, 0}, .target = {0, 0, 0}, .up = {0, 0, 0x1p-300}};
  return data;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(scale)

// The largest length is the eye's 7: 2^-3 brings it to 7/8.
BOOST_AUTO_TEST_CASE(lengths_shrink_to_one_and_directions_on_their_own) {
  const SceneData data = unit_scaled(everything());
  BOOST_TEST((data.spheres[0].center == Vec3{0.125, -0.375, 0.25}));
  BOOST_TEST(data.spheres[0].radius == 0.0625);
  BOOST_TEST((data.planes[0].point == Vec3{0, 0, -0.625}));
  BOOST_TEST((data.planes[0].normal == Vec3{0, 0, 0.75}));
  BOOST_TEST(data.planes[0].checker->size == 0.03125);
  BOOST_TEST((data.lights[0].vector == Vec3{0.75, 0.125, 0}));
  BOOST_TEST((data.lights[1].vector == Vec3{0, -0.625, 0.078125}));
  BOOST_TEST((data.camera->eye == Vec3{0.875, 0, 0}));
  BOOST_TEST((data.camera->up == Vec3{0, 0, 0.5}));
}

BOOST_AUTO_TEST_CASE(height_of_an_orthographic_picture_is_a_length) {
  SceneData data = everything();
  data.camera->projection = Projection::orthographic;
  data.camera->height = 16;
  BOOST_TEST(unit_scaled(data).camera->height == 0.5);
  data.camera->projection = Projection::perspective;
  BOOST_TEST(unit_scaled(data).camera->height == 16);
}

BOOST_AUTO_TEST_CASE(scene_of_unit_scale_stays_as_it_is) {
  const SceneData once = unit_scaled(everything());
  const SceneData twice = unit_scaled(once);
  BOOST_TEST((once.spheres[0].center == twice.spheres[0].center));
  BOOST_TEST(largest_length_of(twice) == 0.875);
  BOOST_TEST(largest_length_of(SceneData{}) == 0);
  BOOST_TEST(unit_scaled(SceneData{}).spheres.empty());
}

// At both ends of the range of double, denormal numbers included.
BOOST_AUTO_TEST_CASE(ends_of_the_range_are_reached) {
  for (const double size : {0x1p-1070, 0x1p-1022, 0x1p1023}) {
    SceneData data;
    add_sphere(data, {size, -size / 2, 0}, size / 8);
    const SceneData scaled = unit_scaled(data);
    BOOST_TEST((scaled.spheres[0].center == Vec3{0.5, -0.25, 0}));
    BOOST_TEST(scaled.spheres[0].radius == 0.0625);
    BOOST_TEST(!problem_with_span(data));
  }
}

// Powers of two do not change a bit of the picture, unit scale or not.
BOOST_AUTO_TEST_CASE(picture_of_a_scaled_scene_is_the_same) {
  SceneData data = random_scene(scene_kinds().front(), 61);
  data.image.width = 48;
  data.image.height = 32;
  data.camera = framed_camera(bounds_of(data), 48, 32);
  const Image plain = render_picture(Scene(data, Kernel::automatic), PixelFormat::rgb32f);
  const Image scaled = render_picture(Scene(unit_scaled(data), Kernel::automatic), PixelFormat::rgb32f);
  BOOST_TEST((plain.bytes == scaled.bytes));
}

// More than 1e140 between the largest length and the smallest radius is refused with both; radius 0 does not count.
BOOST_AUTO_TEST_CASE(span_of_a_scene_is_limited) {
  SceneData data;
  add_sphere(data, {1e100, 0, 0}, 1e-39);
  add_sphere(data, {0, 1, 0}, 0);
  BOOST_TEST(!problem_with_span(data));
  data.spheres[0].radius = 1e-41;
  const std::string problem = problem_with_span(data).value_or("");
  BOOST_TEST(problem.find("from 1e-41 to 1e+100") != std::string::npos, problem);
}

BOOST_AUTO_TEST_CASE(cells_of_a_board_count_as_lengths) {
  SceneData data;
  add_plane(data, {0, 0, 1}, {0, 0, 1});
  data.planes[0].checker = Checker{add_material(data, matte()), 1e-139};
  BOOST_TEST(!problem_with_span(data));
  data.planes[0].checker->size = 1e-141;
  BOOST_TEST(problem_with_span(data).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
