// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_reader.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <string_view>

#include "io/temp_folder.h"

namespace tessera::io {

namespace {

std::string message_of(const std::filesystem::path& path, ErrorKind kind) {
  const auto error = test::error_of([&] { read_scene(path); });
  if (!error) return "no error";
  BOOST_TEST((error->kind() == kind));
  return error->what();
}

constexpr std::string_view kTachyonScene =
    "BEGIN_SCENE\nRESOLUTION 8 8\n"
    "CAMERA ZOOM 1 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 3 CENTER 0 0 -5 VIEWDIR 0 0 1 UPDIR 0 1 0 END_CAMERA\n"
    "SPHERE CENTER 0 0 0 RAD 1 TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 0 0 TEXFUNC 0\nEND_SCENE\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(SceneReader)

BOOST_AUTO_TEST_CASE(the_ending_in_any_case_tells_the_format) {
  const test::TempFolder folder;
  const std::string row("\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\xf0\x3f", 32);  // 0 0 0 1
  for (const auto& path :
       {folder.write("a.toml", "sphere = [{center = [0, 0, 0], radius = 1}]"),
        folder.write("b.TOML", "sphere = [{center = [0, 0, 0], radius = 1}]"), folder.write("c.dat", kTachyonScene),
        folder.write("d.txt", "0 0 0 1"), folder.write("e.csv", "x,y,z,r\n0,0,0,1"), folder.write("f.Bin", row)}) {
    const auto scene = read_scene(path).scene;
    BOOST_TEST_REQUIRE(scene.spheres.size() == 1u, path);
    BOOST_TEST(scene.spheres[0].radius == 1, path);
  }
}

BOOST_AUTO_TEST_CASE(a_table_alone_gets_lights_and_no_camera) {
  const test::TempFolder folder;
  const auto [scene, notes] = read_scene(folder.write("cloud.txt", "0 0 0 1\n1 1 1 1\n"));
  BOOST_TEST(!scene.camera);
  BOOST_TEST(scene.lights.size() == 2u);
  BOOST_TEST_REQUIRE(scene.materials.size() == 1u);
  BOOST_TEST((scene.materials[0] == render::Material{}));
  BOOST_TEST(notes.empty());
}

BOOST_AUTO_TEST_CASE(columns_that_a_table_has_beyond_ours_are_noted) {
  const test::TempFolder folder;
  const auto path = folder.write("cloud.csv", "id,x,y,z,r,mass\n7,0,0,0,1,5\n");
  const auto notes = read_scene(path).notes;
  BOOST_TEST_REQUIRE(notes.size() == 1u);
  BOOST_TEST(notes[0] == path.string() + ": columns not used: id, mass");
}

BOOST_AUTO_TEST_CASE(a_missing_file_is_said_to_be_missing) {
  const test::TempFolder folder;
  for (const char* name : {"none.toml", "none.txt", "none.xyz", "none/a.toml"}) {
    BOOST_TEST(message_of(folder / name, ErrorKind::input_missing) == (folder / name).string() + ": no such file");
  }
}

BOOST_AUTO_TEST_CASE(a_folder_is_not_a_scene) {
  const test::TempFolder folder;
  std::filesystem::create_directory(folder / "a.toml");
  BOOST_TEST(message_of(folder / "a.toml", ErrorKind::input_missing) ==
             (folder / "a.toml").string() + ": it is a directory, not a scene file");
}

BOOST_AUTO_TEST_CASE(unknown_endings_are_refused_with_the_known_ones) {
  const test::TempFolder folder;
  const auto message = [&](const char* name) {
    const auto path = folder.write(name, "x");
    return message_of(path, ErrorKind::bad_scene).substr(path.string().size());
  };
  BOOST_TEST(message("a.zip") == ": unknown ending \".zip\" (known: .bin .csv .dat .toml .txt)");
  BOOST_TEST(message("a") == ": unknown ending \"\" (known: .bin .csv .dat .toml .txt)");
  BOOST_TEST(message("a.tml") ==
             ": unknown ending \".tml\" (known: .bin .csv .dat .toml .txt), did you mean \".toml\"?");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
