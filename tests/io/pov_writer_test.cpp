// SPDX-License-Identifier: BSD-3-Clause
#include "io/pov_writer.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>

#include "io/small_scene.h"

namespace tessera::io {

using namespace render;

namespace {

using Notes = std::vector<std::string>;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(PovWriter)

// By hand: forward (0, 1, 0), right (1, 0, 0), up (0, 0, 1); the picture is 2 high and 4 wide.
// Local weights are halved where the mirror takes half. The board's normal is y, so i = x: u = x cross y = z,
// v = y cross z = x; it is cut at the middle of a cell, 0.25 below the plane.
BOOST_AUTO_TEST_CASE(a_scene_is_written_as_by_hand) {
  const std::string expected = R"(// povray +IFILE +Oout.png +W200 +H100 -D +WT1 -A File_Gamma=1.0
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 4 adc_bailout 0 ambient_light rgb <0.5, 0.5, 0.5> }
background { rgb <0.0, 0.0, 0.25> }
camera { orthographic location <0.0, -4.0, 0.0> direction <0.0, 1.0, 0.0>
  right <4.0, 0.0, 0.0> up <0.0, 0.0, 2.0> }
light_source { <4.0, 3.0, 2.0> rgb <1.0, 0.5, 0.0> }
light_source { <0.0, 0.0, 7000.0> rgb <0.25, 0.25, 0.25> parallel point_at <0.0, 0.0, 0.0> }
#declare M0 = texture { pigment { rgb <0.5, 0.25, 0.125> } finish { ambient 0.1 diffuse 0.4 phong 0.2 phong_size 20.0 reflection 0.5 } }
#declare M1 = texture { pigment { rgb <1.0, 0.0, 0.0> } finish { ambient 0.1 diffuse 0.9 } }
plane { <0.0, 0.0, 1.0>, -2.0 texture { M1 } }
plane { <0.0, 1.0, 0.0>, 0.0
  texture { checker texture { M0 }, texture { M1 } matrix <0.0, 0.0, 0.5, 0.5, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, -0.25, 7.0> } }
sphere { <1.0, 2.0, 3.0>, 0.5 texture { M0 } }
)";
  SceneData scene = test::small_scene();
  scene.spheres.resize(1);
  std::string text = write_pov(scene).text;
  // A zero may have a sign.
  for (std::size_t at; (at = text.find("-0.0,")) != std::string::npos;) text.erase(at, 1);
  for (std::size_t at; (at = text.find("-0.0>")) != std::string::npos;) text.erase(at, 1);
  BOOST_TEST(text == expected);
}

BOOST_AUTO_TEST_CASE(a_left_handed_picture_has_its_right_on_the_left) {
  SceneData scene = test::small_scene();
  scene.camera->handedness = Handedness::left;
  BOOST_TEST(has(write_pov(scene).text, "right <-4.0, "));
}

// 2 tan 45 degrees at distance 1.
BOOST_AUTO_TEST_CASE(a_perspective_picture_is_as_high_as_its_angle) {
  SceneData scene = test::small_scene();
  scene.camera->projection = Projection::perspective;
  scene.camera->fov = 90;
  const std::string text = write_pov(scene).text;
  BOOST_TEST(has(text, "camera { location"));
  const std::string_view before = "up <0.0, 0.0, ";
  BOOST_TEST_REQUIRE(has(text, std::string(before)));
  BOOST_TEST(std::abs(std::strtod(text.c_str() + text.find(before) + before.size(), nullptr) - 2) < 1e-15);
}

BOOST_AUTO_TEST_CASE(blinn_highlights_are_of_the_other_kind) {
  SceneData scene = test::small_scene();
  scene.image.shade = Shade::blinn;
  BOOST_TEST(has(write_pov(scene).text, "specular 0.2 roughness 0.05 "));
}

BOOST_AUTO_TEST_CASE(what_differs_is_noted) {
  SceneData scene = test::small_scene();
  BOOST_TEST(write_pov(scene).notes ==
             Notes{"drawn darker: what is seen beyond the last bounce (POV-Ray shows black there)"});
  scene.environment.background = {};
  BOOST_TEST(write_pov(scene).notes == Notes{});
  scene.image.max_bounces = 300;
  scene.image.samples = 4;
  scene.spheres[0].radius = 0;
  scene.materials[0].reflection = 1;
  const WrittenScene written = write_pov(scene);
  BOOST_TEST(has(written.text, "max_trace_level 256 "));
  BOOST_TEST(!has(written.text, "sphere { <1.0"));
  BOOST_TEST(written.notes ==
             (Notes{"paths end after 255 bounces instead of 300", "left out: 1 sphere of radius 0, which is never seen",
                    "without ambient, diffuse and specular, of which nothing is seen: 1 material with "
                    "reflection 1",
                    "not said: 4 samples per pixel"}));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
