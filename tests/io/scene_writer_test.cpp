// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_writer.h"

#include <boost/test/unit_test.hpp>

#include "io/small_scene.h"

namespace tessera::io {

BOOST_AUTO_TEST_SUITE(SceneWriter)

BOOST_AUTO_TEST_CASE(the_ending_tells_the_format_whatever_its_case) {
  BOOST_TEST((scene_format_of("a/b.dat") == SceneFormat::tachyon));
  BOOST_TEST((scene_format_of("b.c.POV") == SceneFormat::pov));
  for (const char* name : {"a", "a.png", "a.txt", ".pov", "dat", ""}) {
    BOOST_TEST(!scene_format_of(name).has_value(), name);
  }
}

BOOST_AUTO_TEST_CASE(each_format_gets_its_writer) {
  const render::SceneData scene = test::small_scene();
  BOOST_TEST(write_scene(SceneFormat::pov, scene).text.starts_with("// povray "));
  BOOST_TEST(write_scene(SceneFormat::tachyon, scene).text.starts_with("# tachyon "));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
