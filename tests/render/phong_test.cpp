// SPDX-License-Identifier: BSD-3-Clause
#include "render/phong.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "render/random.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr Vec3 kUp{0, 0, 1};

Material glossy(double shininess) {
  return {.color = {0.5, 1, 2}, .ambient = 1, .diffuse = 0, .specular = 1, .shininess = shininess, .reflection = 0};
}

Rgb reflected(const Material& material, const Vec3& to_light, const Vec3& to_viewer, Shade shade = Shade::phong) {
  return reflected_light(material, {1, 1, 1}, shade, kUp, to_light, to_viewer);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(phong)

// I diffuse color N.L = (1, 2, 4) 0.5 (0.5, 1, 2) 0.8
BOOST_AUTO_TEST_CASE(diffuse_term_is_light_times_color_times_cosine) {
  const Material material{.color = {0.5, 1, 2}, .ambient = 1, .diffuse = 0.5};
  const Rgb sum = reflected_light(material, {1, 2, 4}, Shade::phong, kUp, {0.6, 0, 0.8}, kUp);
  BOOST_TEST(std::abs(sum.r - 0.2) <= 1e-16);
  BOOST_TEST(std::abs(sum.g - 0.8) <= 2e-16);
  BOOST_TEST(std::abs(sum.b - 3.2) <= 1e-15);
}

// The mirrored light runs into the eye: R.V = 1, in the light's colour, not the material's.
BOOST_AUTO_TEST_CASE(highlight_is_full_in_the_mirror_direction_and_has_the_colour_of_the_light) {
  const Rgb sum = reflected_light(glossy(40), {1, 2, 4}, Shade::phong, kUp, {0.6, 0, 0.8}, {-0.6, 0, 0.8});
  BOOST_TEST(std::abs(sum.r - 1) <= 1e-14);
  BOOST_TEST(std::abs(sum.g - 2) <= 2e-14);
  BOOST_TEST(std::abs(sum.b - 4) <= 4e-14);
}

// R.V = 2 (N.L)(N.V) - L.V = 2 0.8 1 - 0.8 = 0.8
BOOST_AUTO_TEST_CASE(highlight_falls_with_the_power_of_r_dot_v) {
  BOOST_TEST(std::abs(reflected(glossy(2), {0.6, 0, 0.8}, kUp).r - 0.64) <= 1e-15);
  BOOST_TEST(std::abs(reflected(glossy(1), {0.6, 0, 0.8}, kUp).r - 0.8) <= 1e-15);
}

BOOST_AUTO_TEST_CASE(shininess_zero_is_a_full_highlight_wherever_r_dot_v_is_positive) {
  BOOST_TEST(reflected(glossy(0), {0.6, 0, 0.8}, kUp).g == 1);
}

BOOST_AUTO_TEST_CASE(no_light_comes_from_behind_the_surface_even_at_shininess_zero) {
  Material material = glossy(0);
  material.diffuse = 1;
  BOOST_TEST((reflected(material, {0.6, 0, -0.8}, {0.6, 0, 0.8}) == Rgb{}));
  BOOST_TEST((reflected(material, {1, 0, 0}, kUp) == Rgb{}), "N.L = 0");
}

// L and V on the same side at 45 degrees: R.V = 0; further down it is negative.
BOOST_AUTO_TEST_CASE(no_highlight_where_r_dot_v_is_not_positive_even_at_shininess_zero) {
  BOOST_TEST((reflected(glossy(0), {0.8, 0, 0.6}, {0.8, 0, 0.6}) == Rgb{}));
  BOOST_TEST((reflected(glossy(0), {0, 0, 1}, {1, 0, 0}) == Rgb{}), "R.V = 0");
}

// N.H with H = (L + V) / |L + V|; for V = N: N.H = cos(half the angle), (N.H)^2 = (1 + 0.8) / 2.
BOOST_AUTO_TEST_CASE(blinn_uses_the_half_vector) {
  BOOST_TEST(std::abs(reflected(glossy(2), {0.6, 0, 0.8}, kUp, Shade::blinn).r - 0.9) <= 1e-15);
  BOOST_TEST((reflected(glossy(0), {0.6, 0, -0.8}, kUp, Shade::blinn) == Rgb{}));
}

// L = -V along the surface: L + V = 0 must not be normalised into a NaN.
BOOST_AUTO_TEST_CASE(light_opposite_to_the_viewer_makes_no_nan) {
  for (const Shade shade : {Shade::phong, Shade::blinn}) {
    BOOST_TEST((reflected(glossy(5), {1, 0, 0}, {-1, 0, 0}, shade) == Rgb{}));
  }
}

// Both of them at most I (diffuse color + specular): the bound behind every cut.
BOOST_AUTO_TEST_CASE(reflected_light_is_bounded_by_the_weights) {
  Random random(71);
  double most = 0;
  for (int i = 0; i != 20000; ++i) {
    Material material = glossy(i % 7 == 0 ? 0 : random.over_decades(0.1, 1e6));
    material.diffuse = 0.5;
    material.color = {1, 1, 1};
    const Shade shade = i % 2 == 0 ? Shade::phong : Shade::blinn;
    const Vec3 n = random.direction();
    most = std::max(most, reflected_light(material, {1, 1, 1}, shade, n, random.direction(), n).r);
    most = std::max(most, reflected_light(material, {1, 1, 1}, shade, n, n, n).r / (1 + 1e-15 * material.shininess));
  }
  BOOST_TEST(most <= 1.5 * (1 + 1e-14));
}

BOOST_AUTO_TEST_SUITE_END()
