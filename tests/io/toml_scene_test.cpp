// SPDX-License-Identifier: BSD-3-Clause
#include "io/toml_scene.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <string_view>

#include "io/temp_folder.h"

namespace tessera::io {

using namespace render;

namespace {

struct Scenes {
  test::TempFolder folder;

  ReadScene read(std::string_view text) { return read_toml_scene(folder.write("s.toml", text)); }
  SceneData scene(std::string_view text) { return read(text).scene; }
};

const Material& material_of(const SceneData& scene, MaterialIndex index) {
  return scene.materials.at(static_cast<std::size_t>(index));
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(TomlScene, Scenes)

BOOST_AUTO_TEST_CASE(everything_has_a_default) {
  const SceneData s = scene("format = 1");
  BOOST_TEST(s.spheres.empty());
  BOOST_TEST(s.planes.empty());
  BOOST_TEST(s.lights.empty());
  BOOST_TEST(s.materials.empty());
  BOOST_TEST(!s.camera);
  BOOST_TEST((s.environment.ambient == Rgb{1, 1, 1}));
  BOOST_TEST((s.environment.background == Rgb{0, 0, 0}));
  BOOST_TEST(s.image.width == 1280u);
  BOOST_TEST(s.image.height == 720u);
  BOOST_TEST(s.image.samples == 1u);
  BOOST_TEST(s.image.max_bounces == 5u);
  BOOST_TEST((s.image.transfer == Transfer::srgb));
  BOOST_TEST((s.image.shade == Shade::phong));
}

BOOST_AUTO_TEST_CASE(image_takes_every_key) {
  const auto image = scene(R"(
[image]
width = 320
height = 200
samples = 16
max_bounces = 0
transfer = "none"
shade = "blinn"
)")
                         .image;
  BOOST_TEST(image.width == 320u);
  BOOST_TEST(image.height == 200u);
  BOOST_TEST(image.samples == 16u);
  BOOST_TEST(image.max_bounces == 0u);
  BOOST_TEST((image.transfer == Transfer::none));
  BOOST_TEST((image.shade == Shade::blinn));
  const auto defaults = scene("[image]\ntransfer = \"srgb\"\nshade = \"phong\"").image;
  BOOST_TEST((defaults.transfer == Transfer::srgb));
  BOOST_TEST((defaults.shade == Shade::phong));
}

BOOST_AUTO_TEST_CASE(camera_needs_only_eye_and_target) {
  const auto camera = scene("[camera]\neye = [2.5, 1, 1]\ntarget = [0, 0, 0]").camera.value();
  BOOST_TEST((camera.eye == Vec3{2.5, 1, 1}));
  BOOST_TEST((camera.target == Vec3{0, 0, 0}));
  BOOST_TEST((camera.up == Vec3{0, 0, 1}));
  BOOST_TEST((camera.projection == Projection::perspective));
  BOOST_TEST(camera.fov == 45);
  BOOST_TEST((camera.handedness == Handedness::right));
}

BOOST_AUTO_TEST_CASE(camera_takes_every_key) {
  const auto perspective = scene(R"(
[camera]
eye = [1, 2, 3]
target = [4, 5, 6]
up = [0, 1, 0]
fov = 30.5
handedness = "left"
)")
                               .camera.value();
  BOOST_TEST((perspective.target == Vec3{4, 5, 6}));
  BOOST_TEST((perspective.up == Vec3{0, 1, 0}));
  BOOST_TEST(perspective.fov == 30.5);
  BOOST_TEST((perspective.handedness == Handedness::left));

  const auto orthographic =
      scene("[camera]\neye = [1, 2, 3]\ntarget = [0, 0, 0]\nheight = 4\nhandedness = \"right\"").camera.value();
  BOOST_TEST((orthographic.projection == Projection::orthographic));
  BOOST_TEST(orthographic.height == 4);
  BOOST_TEST((orthographic.handedness == Handedness::right));
}

BOOST_AUTO_TEST_CASE(environment_takes_every_key) {
  const auto environment = scene("[environment]\nambient = [0.5, 1, 2]\nbackground = \"#00ff80\"").environment;
  BOOST_TEST((environment.ambient == Rgb{0.5, 1, 2}));
  BOOST_TEST(environment.background.r == 0);
  BOOST_TEST(environment.background.g == 1);
  BOOST_TEST(std::abs(environment.background.b - std::pow((128 / 255.0 + 0.055) / 1.055, 2.4)) < 1e-15);
}

BOOST_AUTO_TEST_CASE(lights_are_points_or_directions_and_store_color_times_intensity) {
  const auto lights = scene(R"(
[[light]]
position = [4, 3, 2]
[[light]]
direction = [0, 0, -1]
color = [1, 0.5, 0.25]
intensity = 2
)")
                          .lights;
  BOOST_TEST_REQUIRE(lights.size() == 2u);
  BOOST_TEST((lights[0].kind == LightKind::point));
  BOOST_TEST((lights[0].vector == Vec3{4, 3, 2}));
  BOOST_TEST((lights[0].color == Rgb{1, 1, 1}));
  BOOST_TEST((lights[1].kind == LightKind::directional));
  BOOST_TEST((lights[1].vector == Vec3{0, 0, -1}));
  BOOST_TEST((lights[1].color == Rgb{2, 1, 0.5}));
}

BOOST_AUTO_TEST_CASE(materials_take_every_key_and_have_defaults) {
  const auto s = scene(R"(
[material.gold]
color = [1.0, 0.75, 0.33]
ambient = 0.2
diffuse = 0.3
specular = 0.4
shininess = 50
reflection = 0.6
[material.plain]
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "gold"
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "plain"
)");
  BOOST_TEST(s.materials.size() == 2u);
  BOOST_TEST((material_of(s, s.spheres.at(0).material) == Material{{1, 0.75, 0.33}, 0.2, 0.3, 0.4, 50, 0.6}));
  BOOST_TEST((material_of(s, s.spheres.at(1).material) == Material{}));
}

BOOST_AUTO_TEST_CASE(spheres_without_a_material_share_the_default_one) {
  const auto s = scene("sphere = [{center = [1, 2, 3], radius = 0.5}, {center = [0, 0, 0], radius = 0}]");
  BOOST_TEST_REQUIRE(s.spheres.size() == 2u);
  BOOST_TEST((s.spheres[0].center == Vec3{1, 2, 3}));
  BOOST_TEST(s.spheres[0].radius == 0.5);
  BOOST_TEST(s.materials.size() == 1u);
  BOOST_TEST((material_of(s, s.spheres[1].material) == Material{}));
}

BOOST_AUTO_TEST_CASE(planes_take_every_key) {
  const auto s = scene(R"(
[material.white]
color = [1, 1, 1]
[material.black]
color = "#000000"
[[plane]]
point = [0, 0, -0.5]
normal = [0, 0, 2]
material = "white"
checker_material = "black"
checker_size = 0.25
[[plane]]
point = [1, 0, 0]
normal = [1, 0, 0]
checker_material = "black"
[[plane]]
point = [2, 0, 0]
normal = [1, 0, 0]
)");
  BOOST_TEST_REQUIRE(s.planes.size() == 3u);
  BOOST_TEST((s.planes[0].point == Vec3{0, 0, -0.5}));
  BOOST_TEST((s.planes[0].normal == Vec3{0, 0, 2}));
  BOOST_TEST((material_of(s, s.planes[0].material).color == Rgb{1, 1, 1}));
  BOOST_TEST((material_of(s, s.planes[0].checker.value().material).color == Rgb{0, 0, 0}));
  BOOST_TEST(s.planes[0].checker->size == 0.25);
  BOOST_TEST((material_of(s, s.planes[1].material) == Material{}));
  BOOST_TEST(s.planes[1].checker.value().size == 1);
  BOOST_TEST(!s.planes[2].checker);
}

BOOST_AUTO_TEST_CASE(tables_are_read_from_files_beside_the_scene) {
  std::filesystem::create_directory(folder / "data");
  folder.write("data/cloud.txt", "1 2 3 4\n1 2 3 4 1 0 0\n1 2 3 4 tin\n");
  folder.write("extra.csv", "mass,x,y,z,r\n9,5,6,7,8\n");
  folder.write("rows.bin", std::string(32, '\0'));
  const auto [s, notes] = read(R"(
[material.gold]
specular = 0.5
[material.tin]
specular = 0.25
[[sphere]]
center = [9, 9, 9]
radius = 9
[[spheres]]
file = "data/cloud.txt"
material = "gold"
[[spheres]]
file = "extra.csv"
[[spheres]]
file = "rows.bin"
columns = ["z", "y", "x", "r"]
)");
  BOOST_TEST_REQUIRE(s.spheres.size() == 6u);
  BOOST_TEST(s.spheres[0].radius == 9);
  BOOST_TEST((material_of(s, s.spheres[1].material) == Material{.specular = 0.5}));
  BOOST_TEST((material_of(s, s.spheres[2].material) == Material{.color = {1, 0, 0}, .specular = 0.5}));
  BOOST_TEST((material_of(s, s.spheres[3].material) == Material{.specular = 0.25}));
  BOOST_TEST((s.spheres[4].center == Vec3{5, 6, 7}));
  BOOST_TEST((material_of(s, s.spheres[4].material) == Material{}));
  BOOST_TEST(s.spheres[5].radius == 0);
  BOOST_TEST(s.materials.size() == 4u);
  BOOST_TEST_REQUIRE(notes.size() == 1u);
  BOOST_TEST(notes[0].ends_with("extra.csv: columns not used: mass"));
}

BOOST_AUTO_TEST_CASE(a_table_may_have_an_absolute_path) {
  const auto path = folder.write("cloud.txt", "1 2 3 4\n");
  BOOST_TEST(scene("[[spheres]]\nfile = \"" + path.string() + "\"").spheres.size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_sphereflake_is_generated) {
  const auto s = scene("[generate]\nkind = \"sphereflake\"");
  BOOST_TEST(s.spheres.size() == 7381u);
  BOOST_TEST(s.materials.size() == 1u);
  const auto moved = scene(R"(
[material.a]
[material.b]
specular = 1
[generate]
kind = "sphereflake"
level = 1
center = [1, 2, 3]
radius = 3
materials = ["b", "a"]
)");
  BOOST_TEST_REQUIRE(moved.spheres.size() == 10u);
  BOOST_TEST((moved.spheres[0].center == Vec3{1, 2, 3}));
  BOOST_TEST(moved.spheres[0].radius == 3);
  BOOST_TEST(material_of(moved, moved.spheres[0].material).specular == 1);
  BOOST_TEST(material_of(moved, moved.spheres[1].material).specular == 0);
}

BOOST_AUTO_TEST_CASE(a_cloud_is_generated) {
  BOOST_TEST(scene("[generate]\nkind = \"cloud\"").spheres.size() == 10'000u);
  const std::string keys = "[material.a]\n[generate]\nkind = \"cloud\"\ncount = 50\nseed = 3\nmaterial = \"a\"\n";
  const auto s = scene(keys);
  const auto moved = scene(keys + "fill = 1.4\ncenter = [10, 0, 0]\nscale = 2\n");
  BOOST_TEST_REQUIRE(s.spheres.size() == 50u);
  BOOST_TEST((moved.spheres[7].center == Vec3{10, 0, 0} + 2 * s.spheres[7].center));
  BOOST_TEST(std::abs(moved.spheres[7].radius / s.spheres[7].radius - 4) < 1e-14);
  BOOST_TEST(s.materials.size() == 1u);
}

BOOST_AUTO_TEST_CASE(integers_will_do_where_numbers_are_expected) {
  const auto s = scene("sphere = [{center = [-1, 2, 9007199254740993], radius = 9223372036854775807}]");
  BOOST_TEST(s.spheres.at(0).center.x == -1);
  BOOST_TEST(s.spheres.at(0).radius == 0x1p63);
}

BOOST_AUTO_TEST_CASE(any_line_end_will_do) {
  BOOST_TEST(scene("[image]\r\nwidth = 99\r\n\r\n[camera]\r\neye = [1, 1, 1]\r\ntarget = [0, 0, 0]\r\n").image.width ==
             99u);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
