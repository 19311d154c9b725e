// SPDX-License-Identifier: BSD-3-Clause
#include "io/toml_writer.h"

#include <boost/test/unit_test.hpp>

#include "io/scene_codec.h"
#include "io/small_scene.h"
#include "io/temp_folder.h"
#include "io/toml_scene.h"
#include "render/scene_kinds.h"

namespace tessera::io {

using namespace render;
using test::material_of;

namespace {

struct Files {
  test::TempFolder folder;
  std::string table_name = "a.spheres.txt";

  SceneData read_back(const SceneData& scene) {
    const WrittenScene written = write_toml(scene, table_name);
    if (!written.sphere_table.empty()) folder.write(table_name, written.sphere_table);
    return read_toml_scene(folder.write("a.toml", written.text)).scene;
  }

  /// Every number to the bit.
  void check_round_trip(const SceneData& scene) { BOOST_TEST((encode_scene(read_back(scene)) == encode_scene(scene))); }
};

/// More spheres than a scene file takes, each in one of `colors` colours.
SceneData crowd(std::uint32_t colors) {
  render::test::Random random(colors);
  SceneData scene = test::small_scene();
  for (std::uint32_t i = 2; i < colors; ++i) {
    Material material = scene.materials[i % 2];
    material.color = {random.uniform(), random.uniform(), random.uniform()};
    scene.materials.push_back(material);
  }
  for (std::uint32_t i = 0; i < 1000; ++i) {
    scene.spheres.push_back({random.in_box(10), random.uniform(), MaterialIndex{random.below(colors)}});
  }
  return scene;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(TomlWriter, Files)

BOOST_AUTO_TEST_CASE(one_of_everything_reads_back_as_it_was) {
  SceneData scene = test::small_scene();
  check_round_trip(scene);
  scene.camera = Camera{{1, 2, 3}, {0.1, 0.2, 0.3}, {0, 1, 0}};
  scene.camera->fov = 33.3;
  scene.camera->handedness = Handedness::left;
  scene.image = {7, 5, 9, 0, Transfer::srgb, Shade::blinn};
  check_round_trip(scene);
  scene.camera.reset();
  check_round_trip(scene);
  check_round_trip({});
}

BOOST_AUTO_TEST_CASE(random_scenes_read_back_as_they_were) {
  for (const auto& kind : render::test::scene_kinds()) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      BOOST_TEST_CONTEXT(kind.name << ", seed " << seed) {
        check_round_trip(render::test::random_scene(kind, seed));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(many_spheres_go_into_a_table) {
  const SceneData scene = crowd(12);
  const WrittenScene written = write_toml(scene, table_name);
  BOOST_TEST(written.notes == std::vector<std::string>{"the 1002 spheres are in a.spheres.txt"});
  BOOST_TEST(written.sphere_table.starts_with("1.0 2.0 3.0 0.5 m00\n-1.25 1e-09 1e+22 2.0 m01\n"));
  BOOST_TEST(written.text.find("[[sphere]]") == std::string::npos);
  check_round_trip(scene);
  BOOST_TEST(write_toml(test::small_scene(), table_name).sphere_table.empty());
}

BOOST_AUTO_TEST_CASE(many_colors_go_into_the_rows_and_every_sphere_keeps_its_material) {
  SceneData scene = crowd(400);
  scene.planes[0].material = MaterialIndex{399};
  const SceneData read = read_back(scene);
  BOOST_TEST_REQUIRE(read.spheres.size() == scene.spheres.size());
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const Sphere &a = scene.spheres[i], &b = read.spheres[i];
    BOOST_TEST(coincide(a, b), "sphere " << i);
    BOOST_TEST((material_of(scene, a.material) == material_of(read, b.material)), "sphere " << i);
  }
  for (std::size_t i = 0; i < scene.planes.size(); ++i) {
    BOOST_TEST((material_of(scene, scene.planes[i].material) == material_of(read, read.planes[i].material)));
  }
  const std::string text = write_toml(scene, table_name).text;
  BOOST_TEST(text.find("[material.m399]") != std::string::npos);
  BOOST_TEST(text.find("[material.m398]") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_table_may_have_any_name) {
  table_name = "a \"b\" \\u0041 \t# '.txt";
  check_round_trip(crowd(2));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
