// SPDX-License-Identifier: BSD-3-Clause
#include "io/default_lights.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace tessera::io {

using render::Vec3;

BOOST_AUTO_TEST_SUITE(DefaultLights)

BOOST_AUTO_TEST_CASE(the_key_comes_from_above_the_eyes_left_and_the_fill_is_weaker) {
  // Looking along +y with z up, the eye's left is -x
  const auto lights = default_lights({0, 5, 0});
  BOOST_TEST_REQUIRE(lights.size() == 2u);
  for (const auto& light : lights) {
    BOOST_TEST((light.kind == render::LightKind::directional));
    BOOST_TEST(std::abs(length(light.vector) - 1) < 1e-15);
    BOOST_TEST(light.vector.y > 0);  // away from the eye
  }
  BOOST_TEST(lights[0].vector.x > 0);
  BOOST_TEST(lights[0].vector.z < 0);
  BOOST_TEST(lights[1].vector.x < 0);
  BOOST_TEST(lights[1].color.r < 0.5 * lights[0].color.r);
}

BOOST_AUTO_TEST_CASE(they_turn_with_the_view) {
  // Looking along +x with z up, the eye's left is +y
  const auto lights = default_lights({1, 0, 0});
  BOOST_TEST(lights[0].vector.x > 0);
  BOOST_TEST(lights[0].vector.y < 0);
  BOOST_TEST(lights[0].vector.z < 0);
}

BOOST_AUTO_TEST_CASE(a_view_along_the_vertical_has_lights_too) {
  for (const double z : {-1.0, 1.0}) {
    for (const auto& light : default_lights({0, 0, z})) {
      BOOST_TEST(is_finite(light.vector));
      BOOST_TEST(light.vector.z * z > 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_white_surface_facing_the_eye_is_not_washed_out) {
  // At the default material's weights, no surface gets more than the display's white
  double most = 0.1;
  for (const auto& light : default_lights({-1, 2, -1})) most += 0.9 * 0.8 * light.color.r;
  BOOST_TEST(most <= 1);
  BOOST_TEST(most >= 0.7);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
