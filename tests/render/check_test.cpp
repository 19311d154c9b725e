// SPDX-License-Identifier: BSD-3-Clause
#include "render/check.h"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <string>

#include "render/camera.h"

using namespace tessera::render;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kNotFinite[] = {kNan, kInf, -kInf};

/// A valid thing with one field changed.
template <class Thing, class Change>
Thing with(Thing thing, Change change) {
  change(thing);
  return thing;
}

template <class Thing>
bool is_refused(const Thing& thing) {
  const auto problem = problem_with(thing);
  return problem.has_value() && !problem->empty();
}

/// The message holds all of these words.
template <class Thing>
bool says(const Thing& thing, std::initializer_list<std::string> words) {
  const std::string problem = problem_with(thing).value_or("");
  BOOST_TEST_INFO("message: " << problem);
  for (const std::string& word : words) {
    BOOST_TEST_INFO("missing: " << word);
    if (problem.find(word) == std::string::npos) return false;
  }
  return true;
}

Light light(LightKind kind, const Vec3& vector, const Rgb& color = {1, 1, 1}) {
  return {kind, vector, color};
}
Plane plane(const Vec3& point, const Vec3& normal) {
  return {point, normal, {}, std::nullopt};
}
Plane board(double size) {
  return {{}, {0, 0, 1}, {}, Checker{{}, size}};
}

const Camera kCamera{.eye = {1, 2, 3}, .target = {4, 5, 7}};

}  // namespace

BOOST_AUTO_TEST_SUITE(check)

BOOST_AUTO_TEST_CASE(defaults_are_fine) {
  BOOST_TEST(!is_refused(Material{}));
  BOOST_TEST(!is_refused(Plane{}));
  BOOST_TEST(!is_refused(Light{}));
  BOOST_TEST(!is_refused(kCamera));
  BOOST_TEST(!is_refused(Environment{}));
  BOOST_TEST(!is_refused(ImageSettings{}));
}

BOOST_AUTO_TEST_CASE(radius_must_be_finite_and_not_negative) {
  BOOST_TEST(!is_refused(Sphere{{1, 2, 3}, 0.5}));
  BOOST_TEST(!is_refused(Sphere{{1, 2, 3}, 0}));
  BOOST_TEST((problem_with(Sphere{{1, 2, 3}, -1}) == "radius must be >= 0 (it is -1)"));
  BOOST_TEST(is_refused(Sphere{{1, 2, 3}, -1e-300}));
  for (const double bad : kNotFinite) BOOST_TEST(says(Sphere{{0, 0, 0}, bad}, {"radius"}));
  for (const double bad : kNotFinite) {
    BOOST_TEST(says(Sphere{{bad, 0, 0}, 1}, {"center"}));
    BOOST_TEST(is_refused(Sphere{{0, bad, 0}, 1}));
    BOOST_TEST(is_refused(Sphere{{0, 0, bad}, 1}));
  }
}

BOOST_AUTO_TEST_CASE(weights_of_a_material_must_be_finite_and_not_negative) {
  double Material::*const weights[] = {&Material::ambient, &Material::diffuse, &Material::specular,
                                       &Material::shininess, &Material::reflection};
  for (const auto weight : weights) {
    for (const double bad : {kNan, kInf, -kInf, -1e-9}) {
      BOOST_TEST(is_refused(with(Material{}, [&](Material& m) { m.*weight = bad; })));
    }
    BOOST_TEST(!is_refused(with(Material{}, [&](Material& m) { m.*weight = 0; })));
    BOOST_TEST(!is_refused(with(Material{}, [&](Material& m) { m.*weight = 1; })));
  }
  BOOST_TEST(!is_refused(Material{.shininess = 1e6}));
}

BOOST_AUTO_TEST_CASE(reflection_must_be_between_zero_and_one) {
  BOOST_TEST(says(Material{.reflection = 1.5}, {"reflection", "1.5"}));
  BOOST_TEST(is_refused(Material{.reflection = 1 + 1e-15}));
}

BOOST_AUTO_TEST_CASE(colours_must_be_finite_and_not_negative) {
  for (const double bad : {kNan, kInf, -kInf, -0.1}) {
    for (const Rgb& color : {Rgb{bad, 0, 0}, Rgb{0, bad, 0}, Rgb{0, 0, bad}}) {
      BOOST_TEST(says(Material{.color = color}, {"color"}));
      BOOST_TEST(is_refused(light(LightKind::point, {}, color)));
      BOOST_TEST(is_refused(Environment{.ambient = color}));
      BOOST_TEST(is_refused(Environment{.background = color}));
    }
  }
  BOOST_TEST(!is_refused(Material{.color = {7, 0, 1e30}}));
  BOOST_TEST(!is_refused(light(LightKind::point, {}, {1e30, 0, 7})));
}

BOOST_AUTO_TEST_CASE(plane_needs_a_normal_and_cells_of_some_size) {
  BOOST_TEST(says(plane({0, 0, 0}, {0, 0, 0}), {"normal"}));
  BOOST_TEST(!is_refused(plane({0, 0, 0}, {0, 0, -1e-9})));
  for (const double bad : kNotFinite) {
    BOOST_TEST(says(plane({0, bad, 0}, {0, 0, 1}), {"point"}));
    BOOST_TEST(is_refused(plane({0, 0, 0}, {bad, 0, 1})));
  }
  for (const double bad : {0.0, -1.0, kNan, kInf}) BOOST_TEST(is_refused(board(bad)));
  BOOST_TEST(!is_refused(board(1e-3)));
}

BOOST_AUTO_TEST_CASE(directional_light_needs_a_direction) {
  BOOST_TEST(says(light(LightKind::directional, {0, 0, 0}), {"direction"}));
  BOOST_TEST(!is_refused(light(LightKind::directional, {0, 0, -1e-9})));
  BOOST_TEST(!is_refused(light(LightKind::point, {0, 0, 0})));
  for (const double bad : kNotFinite) {
    BOOST_TEST(says(light(LightKind::point, {bad, 0, 0}), {"position"}));
    BOOST_TEST(is_refused(light(LightKind::directional, {0, 1, bad})));
  }
}

BOOST_AUTO_TEST_CASE(camera_needs_a_view_and_an_up_across_it) {
  BOOST_TEST(says(with(kCamera, [](Camera& c) { c.target = c.eye; }), {"eye", "target"}));
  for (const double along : {1.0, -1.0, 1e-6, 1e6}) {
    BOOST_TEST(says(with(kCamera, [&](Camera& c) { c.up = along * (c.target - c.eye); }), {"up"}));
  }
  BOOST_TEST(is_refused(with(kCamera, [](Camera& c) { c.up = {0, 0, 0}; })));
  BOOST_TEST(!is_refused(with(kCamera, [](Camera& c) { c.up = 1e-9 * c.up; })));
  for (const double bad : kNotFinite) {
    BOOST_TEST(is_refused(with(kCamera, [&](Camera& c) { c.eye.x = bad; })));
    BOOST_TEST(is_refused(with(kCamera, [&](Camera& c) { c.target.y = bad; })));
    BOOST_TEST(is_refused(with(kCamera, [&](Camera& c) { c.up.z = bad; })));
  }
}

BOOST_AUTO_TEST_CASE(field_of_view_must_be_between_0_and_180_degrees) {
  for (const double bad : {0.0, -1.0, 180.0, 360.0, kNan, kInf}) {
    BOOST_TEST(says(with(kCamera, [&](Camera& c) { c.fov = bad; }), {"fov"}));
  }
  for (const double good : {1e-9, 45.0, 179.9})
    BOOST_TEST(!is_refused(with(kCamera, [&](Camera& c) { c.fov = good; })));
}

BOOST_AUTO_TEST_CASE(height_of_an_orthographic_picture_must_be_positive) {
  const Camera flat = with(kCamera, [](Camera& c) { c.projection = Projection::orthographic; });
  BOOST_TEST(!is_refused(flat));
  for (const double bad : {0.0, -1.0, kNan, kInf}) {
    BOOST_TEST(says(with(flat, [&](Camera& c) { c.height = bad; }), {"height"}));
  }
}

BOOST_AUTO_TEST_CASE(picture_must_have_pixels_but_not_too_many) {
  BOOST_TEST(says(ImageSettings{.width = 0}, {"width"}));
  BOOST_TEST(says(ImageSettings{.height = 0}, {"height"}));
  BOOST_TEST(is_refused(ImageSettings{.width = kMaxImageSide + 1}));
  BOOST_TEST(!is_refused(ImageSettings{.width = 1, .height = 10000}));
  BOOST_TEST(!is_refused(ImageSettings{.width = 1, .height = 1, .max_bounces = 0}));
  BOOST_TEST(!is_refused(ImageSettings{.max_bounces = 2147483647}));
}

// k^2 samples; else the message names the squares around the number.
BOOST_AUTO_TEST_CASE(samples_must_be_a_square_number) {
  for (const std::uint32_t good : {1U, 4U, 9U, 16U, 100U, 4096U}) {
    BOOST_TEST(!is_refused(ImageSettings{.samples = good}), good);
  }
  BOOST_TEST(says(ImageSettings{.samples = 5}, {"samples", "4", "9"}));
  BOOST_TEST(says(ImageSettings{.samples = 99}, {"81", "100"}));
  BOOST_TEST(is_refused(ImageSettings{.samples = 0}));
}

BOOST_AUTO_TEST_CASE(more_samples_than_the_most_are_refused_with_the_most) {
  BOOST_TEST(!is_refused(ImageSettings{.samples = kMaxSamples}));
  BOOST_TEST(says(ImageSettings{.samples = kMaxSamples + 1}, {"samples", std::to_string(kMaxSamples)}));
  BOOST_TEST(says(ImageSettings{.samples = 4294967295U}, {"samples", std::to_string(kMaxSamples)}));
}

// Lengths whose square is no double: what passes must still have a direction.
BOOST_AUTO_TEST_CASE(vectors_too_short_or_too_long_to_normalise_are_refused) {
  const auto is_direction = [](const Vec3& v) { return is_finite(v) && dot(v, v) > 0; };
  for (const double length : {5e-324, 1e-300, 1e-200, 1e200, 1e300}) {
    const Camera far_target{.eye = {0, 0, 0}, .target = {length, 0, 0}};
    const Camera odd_up = with(kCamera, [&](Camera& c) { c.up = {0, 0, length}; });
    for (const Camera& camera : {far_target, odd_up}) {
      BOOST_TEST((is_refused(camera) || is_direction(CameraRays(camera, 4, 3).through(0.5, 0.5).direction)), length);
    }
    const Vec3 vector{0, 0, length};
    BOOST_TEST((is_refused(plane({0, 0, 0}, vector)) || is_direction(normalized(vector))), length);
    BOOST_TEST((is_refused(light(LightKind::directional, vector)) || is_direction(normalized(vector))), length);
  }
}

BOOST_AUTO_TEST_SUITE_END()
