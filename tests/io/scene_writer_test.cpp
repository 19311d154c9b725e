// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_writer.h"

#include <boost/test/unit_test.hpp>

#include "io/small_scene.h"

namespace tessera::io {

BOOST_AUTO_TEST_SUITE(SceneWriter)

BOOST_AUTO_TEST_CASE(the_ending_tells_the_format_whatever_its_case) {
  BOOST_TEST((scene_format_of("a/b.dat") == SceneFormat::tachyon));
  BOOST_TEST((scene_format_of("a.Toml") == SceneFormat::toml));
  BOOST_TEST((scene_format_of("b.c.POV") == SceneFormat::pov));
  for (const char* name : {"a", "a.png", "a.txt", ".pov", "dat", ""}) {
    BOOST_TEST(!scene_format_of(name).has_value(), name);
  }
}

BOOST_AUTO_TEST_CASE(each_format_gets_its_writer) {
  const render::SceneData scene = test::small_scene();
  BOOST_TEST(write_scene(SceneFormat::pov, scene, "a.pov").text.starts_with("// povray "));
  BOOST_TEST(write_scene(SceneFormat::tachyon, scene, "a.dat").text.starts_with("# tachyon "));
  BOOST_TEST(write_scene(SceneFormat::toml, scene, "a.toml").text.starts_with("format = 1\n"));
}

BOOST_AUTO_TEST_CASE(a_scene_file_names_the_table_beside_it) {
  BOOST_TEST(sphere_table_beside("x/a.b.toml") == "x/a.b.spheres.txt");
  render::SceneData scene = test::small_scene();
  scene.spheres.resize(1000);
  BOOST_TEST(write_scene(SceneFormat::toml, scene, "x/a.toml").text.find("\"a.spheres.txt\"") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
