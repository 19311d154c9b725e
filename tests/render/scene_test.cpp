// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene.h"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "render/bvh_build.h"
#include "render/scene_fixture.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

SceneData sphere_on_plane() {
  SceneData data;
  add_sphere(data, {0, 0, 2}, 1, glowing({1, 0, 0}));
  add_plane(data, {0, 0, 0}, {0, 0, 1}, glowing({0, 1, 0}));
  return data;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(scene)

BOOST_AUTO_TEST_CASE(a_scene_looks_at_parts_that_others_hold) {
  const SceneData data = sphere_on_plane();
  const SharedArray<Sphere> spheres(nullptr, data.spheres);
  const SharedArray<Material> materials(nullptr, data.materials);
  const Scene scene(spheres, materials, data, Kernel::automatic, build_bvh(data.spheres));
  BOOST_TEST(scene.spheres().data() == data.spheres.data());
  BOOST_TEST(scene.view().materials.data() == data.materials.data());
  BOOST_TEST((seen_from(scene, {0, 0, 9}, {0, 0, -1}) == Rgb{1, 0, 0}));
  BOOST_TEST((seen_from(scene, {5, 0, 9}, {0, 0, -1}) == Rgb{0, 1, 0}));
}

BOOST_AUTO_TEST_CASE(a_plane_without_its_material_is_refused) {
  SceneData data = sphere_on_plane();
  data.planes[0].material = MaterialIndex{2};
  BOOST_CHECK_THROW(Scene(data, Kernel::automatic), std::invalid_argument);
  data = sphere_on_plane();
  data.planes[0].checker = Checker{MaterialIndex{2}, 1};
  BOOST_CHECK_THROW(Scene(data, Kernel::automatic), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
