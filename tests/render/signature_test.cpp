// SPDX-License-Identifier: BSD-3-Clause
#include "render/signature.h"

#include <boost/test/unit_test.hpp>

#include "render/quad_oracle.h"
#include "render/random.h"
#include "render/reference/quad_tracer.h"
#include "render/scene_fixture.h"
#include "render/signature_observer.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

Signature signed_by(const SceneData& data, const Vec3& eye, const Vec3& direction) {
  Signature signature;
  SignatureObserver observer(signature);
  PathObserver* const observers[] = {&observer};
  RayCounts counts;
  seen_from(Scene(data, Kernel::automatic), eye, direction, counts, observers);
  return signature;
}

/// A mirror at the origin, a lit ball above the eye, and a light that a third ball may hide.
SceneData mirror_scene() {
  SceneData data;
  Material half = matte();
  half.reflection = 0.5;
  add_sphere(data, {0, 0, 0}, 1, half);
  add_sphere(data, {0, -6, 0}, 1);
  add_point_light(data, {0, -3, 4});
  return data;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(SignatureOfAPixel)

BOOST_AUTO_TEST_CASE(order_and_kind_of_what_happened_count) {
  const auto path = [](auto... step) {
    Signature signature;
    (step(signature), ...);
    return signature;
  };
  const auto one = [](Signature& s) { s.meet(surface_id(1), Cell::even); };
  const auto odd = [](Signature& s) { s.meet(surface_id(1), Cell::odd); };
  const auto two = [](Signature& s) { s.meet(surface_id(2), Cell::even); };
  const auto none = [](Signature& s) { s.miss(); };
  const auto lit = [](Signature& s) { s.light(true); };
  const auto dark = [](Signature& s) { s.light(false); };
  BOOST_TEST((path(one, two) == path(one, two)));
  BOOST_TEST((path(one, two) != path(two, one)));
  BOOST_TEST((path(one) != path(odd)));
  BOOST_TEST((path(one) != path(one, none)));
  BOOST_TEST((path(none) != path()));
  BOOST_TEST((path(one, lit) != path(one, dark)));
  BOOST_TEST((path(one, lit, dark) != path(one, dark, lit)));
  BOOST_TEST((path(one, dark) != path(one)));
  BOOST_TEST((path(two, one).first == surface_id(2)));
  BOOST_TEST((path(none, one).first == SurfaceId::none));
  BOOST_TEST(path(one, two, none).hits == 2u);
}

BOOST_AUTO_TEST_CASE(a_path_signs_its_surfaces_and_lights) {
  // The mirror is lit; the ray comes back to the second ball, lit too; that is no mirror.
  Signature expected;
  expected.meet(surface_id(0), Cell::even);
  expected.light(true);
  expected.meet(surface_id(1), Cell::even);
  expected.light(true);
  BOOST_TEST((signed_by(mirror_scene(), {0, -3, 0}, {0, 1, 0}) == expected));
}

BOOST_AUTO_TEST_CASE(a_hidden_light_changes_the_lights_alone) {
  SceneData hidden = mirror_scene();
  add_sphere(hidden, {0, -2, 2}, 0.25);
  const Signature a = signed_by(mirror_scene(), {0, -3, 0}, {0, 1, 0});
  const Signature b = signed_by(hidden, {0, -3, 0}, {0, 1, 0});
  BOOST_TEST(a.surfaces == b.surfaces);
  BOOST_TEST(a.lights != b.lights);
}

// The light is within rounding of the plane, on one side or the other, and a highlight of shininess 0 shows which.
BOOST_AUTO_TEST_CASE(both_tracers_agree_about_a_light_next_to_a_plane) {
  SceneData data;
  add_plane(data, {0.1, 0.2, 0.3}, {0.3, 0.5, 0.7}, {.specular = 1, .shininess = 0});
  add_point_light(data, Vec3{0.1, 0.2, 0.3} + Vec3{5, -3, 0});
  Random random(71);
  for (int i = 0; i != 200; ++i) {
    const Vec3 eye = Vec3{1, 2, 3} + random.in_box(0.5);
    const Vec3 direction = random.in_box(1) - eye;
    Signature exact;
    RayCounts counts;
    QuadTracer(data, eye, direction).radiance(exact, counts);
    BOOST_REQUIRE((signed_by(data, eye, direction) == exact));
  }
}

BOOST_AUTO_TEST_SUITE_END()
