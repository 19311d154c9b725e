// SPDX-License-Identifier: BSD-3-Clause
// The scenes that Debian's package tachyon-doc installs: what other people's files look like.
#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/error.h"
#include "io/tachyon_scene.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

const std::filesystem::path kScenes = "/usr/share/doc/tachyon/examples/scenes";

boost::test_tools::assertion_result scenes_are_installed(boost::unit_test::test_unit_id) {
  boost::test_tools::assertion_result installed(std::filesystem::exists(kScenes));
  installed.message() << "tachyon-doc's scenes are not in " << kScenes;
  return installed;
}

// Why some are refused: the end of the message.
const std::map<std::string, std::string> kRefused{
    {"engine", "skipped 1 volume)"},
    {"janbadoutput", "skipped 656 triangles)"},
    {"null", "nothing to draw (no sphere and no plane)"},
    {"polycyl", "skipped 2 polycylinders)"},
    {"skull", "skipped 1 volume)"},
    {"teapot", "skipped 2328 triangles)"},
    {"tetra", "skipped 4096 triangles)"},
    {"texture", "texture.dat:39:3: expected ROTATE (found \"NORMAL\")"},  // Tachyon refuses it too
    {"tpolytest", "skipped 1 triangle file)"},
    {"voltest", "skipped 1 volume)"},
};

}  // namespace

BOOST_AUTO_TEST_SUITE(TachyonExamples, *boost::unit_test::precondition(scenes_are_installed))

BOOST_AUTO_TEST_CASE(each_is_read_or_refused_for_a_reason) {
  std::size_t read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kScenes)) {
    if (entry.path().extension() != ".dat") continue;
    const std::string name = entry.path().stem().string();
    const auto refused = kRefused.find(name);
    const auto error = test::error_of([&] {
      const ReadScene scene = read_tachyon(entry.path());
      BOOST_TEST(!(scene.scene.spheres.empty() && scene.scene.planes.empty()), name);
      BOOST_TEST(!scene.scene.materials.empty(), name);
      ++read;
    });
    BOOST_TEST(error.has_value() == (refused != kRefused.end()), name << ": " << (error ? error->what() : "was read"));
    if (error && refused != kRefused.end())
      BOOST_TEST(std::string(error->what()).ends_with(refused->second), error->what());
  }
  BOOST_TEST(read == 33u);
}

BOOST_AUTO_TEST_CASE(balls_is_the_sphereflake_of_the_procedural_databases) {
  const ReadScene balls = read_tachyon(kScenes / "balls.dat");
  BOOST_TEST(balls.scene.spheres.size() == 7381u);  // 1 + 9 + 81 + 729 + 6561
  BOOST_TEST(balls.scene.planes.size() == 1u);
  BOOST_TEST(balls.scene.lights.size() == 3u);
  BOOST_TEST_REQUIRE(balls.scene.materials.size() == 2u);
  // SPECULAR 0.5 DIFFUSE 0.5 PHONG 0.8: the local weights are doubled
  const render::Material expected{{1, 0.9, 0.7}, 0, 1, 1.6, 45.2776, 0.5};
  BOOST_TEST((balls.scene.materials[1] == expected));
  BOOST_TEST(balls.notes == std::vector<std::string>{"not drawn themselves, they still shine: 3 lights with RAD > 0"});
}

BOOST_AUTO_TEST_CASE(dna_shares_its_inline_textures) {
  const ReadScene dna = read_tachyon(kScenes / "dna.dat");
  BOOST_TEST(dna.scene.spheres.size() == 1904u);
  BOOST_TEST(dna.scene.materials.size() == 5u);
  BOOST_TEST(dna.notes == std::vector<std::string>{"skipped 22 cylinders"});
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
