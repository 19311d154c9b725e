// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_scene.h"

#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using render::LightKind;
using render::MaterialIndex;
using render::Rgb;
using render::Vec3;
using test::error_of;
using Notes = std::vector<std::string>;

const std::string kBegin = "BEGIN_SCENE\nRESOLUTION 320 240\n";
const std::string kCamera =
    "CAMERA ZOOM 1 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 5 CENTER 0 0 -5 VIEWDIR 0 0 1 UPDIR 0 1 0 END_CAMERA\n";
const std::string kGrey = "TEXDEF grey AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR .5 .5 .5 TEXFUNC 0\n";
const std::string kBall = "SPHERE CENTER 1 2 3 RAD 4 grey\n";

struct Fixture {
  test::TempFolder folder;

  ReadScene read_text(const std::string& text) const { return read_tachyon(folder.write("a.dat", text)); }
  ReadScene read(const std::string& statements) const { return read_text(kBegin + statements + "END_SCENE\n"); }

  // What follows the folder's name in the message.
  std::string problem_of_text(const std::string& text) const {
    const auto error = error_of([&] { read_text(text); });
    if (!error) return "none";
    BOOST_TEST((error->kind() == ErrorKind::bad_scene));
    return std::string(error->what()).substr((folder / "").string().size());
  }
  // Statements begin in line 3.
  std::string problem_of(const std::string& statements) const {
    return problem_of_text(kBegin + statements + "END_SCENE\n");
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(TachyonScene, Fixture)

BOOST_AUTO_TEST_CASE(image_and_camera_come_from_the_file) {
  const ReadScene read_back = read(kCamera + kGrey + kBall);
  const render::SceneData& scene = read_back.scene;
  BOOST_TEST(scene.image.width == 320u);
  BOOST_TEST(scene.image.height == 240u);
  BOOST_TEST(scene.image.max_bounces == 4u);
  BOOST_TEST(scene.image.samples == 1u);
  BOOST_TEST((scene.image.transfer == render::Transfer::none));
  BOOST_TEST_REQUIRE(scene.camera.has_value());
  BOOST_TEST((scene.camera->eye == Vec3{0, 0, -5}));
  BOOST_TEST((scene.camera->handedness == render::Handedness::left));
  BOOST_TEST((scene.environment.ambient == Rgb{1, 1, 1}));
  BOOST_TEST((scene.environment.background == Rgb{0, 0, 0}));
  BOOST_TEST(read_back.notes == Notes{});
  BOOST_TEST(!read(kGrey + kBall).scene.camera.has_value());
}

BOOST_AUTO_TEST_CASE(the_last_camera_counts_with_its_notes) {
  const std::string other =
      "CAMERA ZOOM 1 ASPECTRATIO 2 ANTIALIASING 9 RAYDEPTH 2 CENTER 0 0 9 VIEWDIR 0 0 1 UPDIR 0 1 0 END_CAMERA ";
  const ReadScene read_back = read(other + kCamera + kGrey + kBall);
  BOOST_TEST((read_back.scene.camera->eye == Vec3{0, 0, -5}));
  BOOST_TEST(read_back.scene.image.max_bounces == 4u);
  BOOST_TEST(read_back.notes == Notes{});
  BOOST_TEST(read(kCamera + other + kGrey + kBall).notes.size() == 2u);
}

BOOST_AUTO_TEST_CASE(spheres_and_planes_are_drawn) {
  const render::SceneData scene =
      read(kGrey + "sphere center 1 +2 -3e1 rad .5 grey PLANE CENTER 4 5 6 NORMAL 0 0 -2 grey ").scene;
  BOOST_TEST_REQUIRE(scene.spheres.size() == 1u);
  BOOST_TEST((scene.spheres[0].center == Vec3{1, 2, -30}));
  BOOST_TEST(scene.spheres[0].radius == 0.5);
  BOOST_TEST_REQUIRE(scene.planes.size() == 1u);
  BOOST_TEST((scene.planes[0].point == Vec3{4, 5, 6}));
  BOOST_TEST((scene.planes[0].normal == Vec3{0, 0, -2}));
  BOOST_TEST(!scene.planes[0].checker.has_value());
}

BOOST_AUTO_TEST_CASE(equal_materials_are_shared) {
  const std::string inline_texture = "TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR .5 .5 .5 TEXFUNC 0 ";
  const std::string red = "TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR .5 0 0 TEXFUNC 0 ";
  const render::SceneData scene = read("SPHERE CENTER 0 0 0 RAD 1 " + red + "SPHERE CENTER 0 0 0 RAD 1 " +
                                       inline_texture + kGrey + kBall + "SPHERE CENTER 0 0 0 RAD 1 " + red)
                                      .scene;
  BOOST_TEST(scene.materials.size() == 2u);
  const std::vector<MaterialIndex> expected{MaterialIndex{0}, MaterialIndex{1}, MaterialIndex{1}, MaterialIndex{0}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    BOOST_TEST((scene.spheres[i].material == expected[i]), "sphere " << i);
  }
}

BOOST_AUTO_TEST_CASE(texture_names_keep_their_case_and_the_first_definition_counts) {
  const std::string white = " AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0\n";
  const render::SceneData scene = read(kGrey + "TEXDEF Grey" + white + "TEXDEF grey" + white + "TEXALIAS other Grey\n" +
                                       kBall + "SPHERE CENTER 0 0 0 RAD 1 other\n")
                                      .scene;
  const auto color = [&](std::size_t i) {
    return scene.materials[static_cast<std::size_t>(scene.spheres[i].material)].color;
  };
  BOOST_TEST((color(0) == Rgb{.5, .5, .5}));
  BOOST_TEST((color(1) == Rgb{1, 1, 1}));
}

BOOST_AUTO_TEST_CASE(lights_shine_as_in_the_file) {
  const ReadScene read_back =
      read(kGrey + kBall + "LIGHT CENTER 1 2 3 RAD 0 COLOR 2 .5 0\nDIRECTIONAL_LIGHT DIRECTION 0 -7 0 COLOR 1 1 1\n");
  const auto& lights = read_back.scene.lights;
  BOOST_TEST_REQUIRE(lights.size() == 2u);
  BOOST_TEST((lights[0].kind == LightKind::point));
  BOOST_TEST((lights[0].vector == Vec3{1, 2, 3}));
  BOOST_TEST((lights[0].color == Rgb{2, .5, 0}));
  BOOST_TEST((lights[1].kind == LightKind::directional));
  BOOST_TEST((lights[1].vector == Vec3{0, -7, 0}));
  BOOST_TEST(read_back.notes == Notes{});
}

BOOST_AUTO_TEST_CASE(other_lights_come_as_near_as_they_can) {
  const ReadScene read_back =
      read(kGrey + kBall + "LIGHT CENTER 1 2 3 RAD 1 ATTENUATION CONSTANT 1 LINEAR 0 QUADRATIC .1 COLOR 1 1 1\n" +
           "SPOTLIGHT CENTER 4 5 6 RAD 1 DIRECTION 0 -1 0 FALLOFF_START 20 FALLOFF_END 45 COLOR 0 0 1\n" +
           "SKY_LIGHT NUMSAMPLES 16 COLOR 1 1 1\n");
  BOOST_TEST_REQUIRE(read_back.scene.lights.size() == 2u);
  BOOST_TEST((read_back.scene.lights[1].vector == Vec3{4, 5, 6}));
  BOOST_TEST((read_back.scene.lights[1].kind == LightKind::point));
  BOOST_TEST(read_back.notes == (Notes{"not drawn themselves, they still shine: 2 lights with RAD > 0",
                                       "shining without fall-off: 1 light with ATTENUATION",
                                       "shining to all sides: 1 spotlight", "ignored: 1 sky light"}));
}

BOOST_AUTO_TEST_CASE(background_fog_and_modes_are_read) {
  const ReadScene read_back = read(
      "SHADER_MODE medium TRANS_VMD TRANS_MAX_SURFACES 3 AMBIENT_OCCLUSION AMBIENT_COLOR 1 1 1 RESCALE_DIRECT .2 "
      "SAMPLES 16 END_SHADER_MODE\nBACKGROUND .1 .2 .3\nFOG OFF START 0 END 1 DENSITY 1 COLOR 1 1 1\n"
      "FOG EXP2 START 0 END 1 DENSITY 1 COLOR 1 1 1\nBACKGROUND_GRADIENT SKY_SPHERE UPDIR 0 1 0 TOPVAL 1 "
      "BOTTOMVAL -1 TOPCOLOR 0 0 1 BOTTOMCOLOR 0 0 0\nSTART_CLIPGROUP NUMPLANES 2 1 0 0 1 0 1 0 1\n" +
      kGrey + kBall + "END_CLIPGROUP\n");
  BOOST_TEST((read_back.scene.environment.background == Rgb{.1, .2, .3}));
  BOOST_TEST(read_back.notes ==
             (Notes{"ignored, direct light not rescaled: 1 AMBIENT_OCCLUSION block",
                    "drawn with full shading: 1 SHADER_MODE below FULL", "ignored: 1 FOG",
                    "drawn as the plain BACKGROUND: 1 BACKGROUND_GRADIENT", "drawn unclipped: 1 clip group"}));
}

BOOST_AUTO_TEST_CASE(other_shapes_are_skipped_in_one_line) {
  const ReadScene read_back =
      read(kGrey + kBall + "FCYLINDER BASE 0 0 0 APEX 1 1 1 RAD 1 grey\n" +
           "FCYLINDER BASE 0 0 0 APEX 1 1 1 RAD 1 grey\n" + "TRI V0 0 0 0 V1 1 1 1 V2 0 1 0 grey\n" + kBall);
  BOOST_TEST(read_back.scene.spheres.size() == 2u);
  BOOST_TEST(read_back.notes == Notes{"skipped 2 cylinders, 1 triangle"});
}

BOOST_AUTO_TEST_CASE(textures_drawn_in_another_way_are_counted) {
  const std::string glass = "TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY .5 COLOR 1 1 1 TEXFUNC 11\n";
  const ReadScene read_back = read("SPHERE CENTER 0 0 0 RAD 1 " + glass + "SPHERE CENTER 0 0 0 RAD 1 " + glass);
  BOOST_TEST(read_back.notes == (Notes{"drawn as opaque: 2 textures with OPACITY < 1",
                                       "drawn in the plain COLOR: 2 textures with TEXFUNC > 0"}));
}

BOOST_AUTO_TEST_CASE(comments_stand_alone) {
  BOOST_TEST(read_text("# made by hand\n#\n" + kBegin + "# ball\n" + kGrey +
                       "SPHERE # here\nCENTER 0 0 0 RAD 1 grey\n" + "END_SCENE and anything # after it")
                 .scene.spheres.size() == 1u);
  BOOST_TEST(problem_of(kGrey + kBall + "  #ball\n") ==
             "a.dat:5:3: unknown keyword \"#ball\" (a comment's # stands alone) put a blank after it");
}

BOOST_AUTO_TEST_CASE(includes_are_relative_to_the_file_that_names_them) {
  std::filesystem::create_directories(folder / "parts/more");
  folder.write("parts/one.dat", kGrey + "INCLUDE more/two.dat\n" + kBall + "END_SCENE ignored");
  folder.write("parts/more/two.dat", kBall);
  BOOST_TEST(read("INCLUDE parts/one.dat\n" + kBall).scene.spheres.size() == 3u);

  folder.write("parts/more/two.dat", "SPHERE CENTER x");
  BOOST_TEST(problem_of("INCLUDE parts/one.dat\n") == "parts/more/two.dat:1:15: expected a number (found \"x\")");
}

BOOST_AUTO_TEST_CASE(an_include_that_is_missing_or_endless_is_an_error) {
  const auto error = error_of([&] { read(" INCLUDE none.dat\n"); });
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST((error->kind() == ErrorKind::input_missing));
  BOOST_TEST(error->what() == (folder / "a.dat").string() + ":3:10: cannot INCLUDE a file (" +
                                  (folder / "none.dat").string() + ": cannot open (No such file or directory))");

  folder.write("loop.dat", kGrey + kBall + "INCLUDE loop.dat\n");
  BOOST_TEST(problem_of("INCLUDE loop.dat\n") ==
             "loop.dat:3:9: INCLUDEs are nested too deep (more than 16) does a file include itself?");
}

BOOST_AUTO_TEST_CASE(bad_scenes_are_refused_with_their_place) {
  BOOST_TEST(problem_of_text("") == "a.dat:1:1: expected BEGIN_SCENE (the file ends here)");
  BOOST_TEST(problem_of_text("\x7f"
                             "ELF\x01") == "a.dat:1:1: expected BEGIN_SCENE (found \"?ELF?\")");
  BOOST_TEST(problem_of_text("BEGIN_SCENE\n CAMERA") == "a.dat:2:2: expected RESOLUTION (found \"CAMERA\")");
  BOOST_TEST(problem_of_text("BEGIN_SCENE RESOLUTION 0 5").starts_with("a.dat:1:13: width must be "));
  BOOST_TEST(problem_of_text("BEGIN_SCENE RESOLUTION 99999999999 5").starts_with("a.dat:1:13: width must be "));
  BOOST_TEST(problem_of(kGrey + "SPHERE CENTER 1 2 3 RADIUS 4 grey\n") ==
             "a.dat:4:21: expected RAD (found \"RADIUS\")");
  BOOST_TEST(problem_of(kGrey + "SPHERE CENTER 1 2 3 RAD -4 grey\n").starts_with("a.dat:4:25: radius must be "));
  BOOST_TEST(problem_of(kGrey + "SPHERE CENTER 1 2 3 RAD 4 Grey\n") ==
             "a.dat:4:27: unknown texture \"Grey\", did you mean \"grey\"?");
  BOOST_TEST(problem_of("TEXALIAS a b\n") == "a.dat:3:12: unknown texture \"b\" (no TEXDEF of that name before)");
  BOOST_TEST(problem_of("SPHER CENTER\n") == "a.dat:3:1: unknown keyword \"SPHER\", did you mean \"SPHERE\"?");
  BOOST_TEST(problem_of("TIR V0\n") == "a.dat:3:1: unknown keyword \"TIR\", did you mean \"TRI\"?");
  BOOST_TEST(problem_of(kGrey + "PLANE CENTER 0 0 0 NORMAL 0 0 0 grey\n").starts_with("a.dat:4:20: normal must "));
  BOOST_TEST(problem_of("LIGHT CENTER 0 0 0 RAD 0 COLOR 1 -1 1\n").starts_with("a.dat:3:26: color must be "));
  BOOST_TEST(problem_of("DIRECTIONAL_LIGHT DIRECTION 0 0 0 COLOR 1 1 1\n").starts_with("a.dat:3:19: direction must "));
  BOOST_TEST(problem_of("BACKGROUND 0 0 -1\n").starts_with("a.dat:3:1: background must "));
  BOOST_TEST(problem_of("QUADRIC 1 2 3\n") == "a.dat:3:1: unknown keyword \"QUADRIC\" (not a Tachyon statement)");
  BOOST_TEST(problem_of("CAMERA ZOOM 1\n") == "a.dat:4:1: expected ASPECTRATIO (found \"END_SCENE\")");
}

BOOST_AUTO_TEST_CASE(a_scene_without_spheres_and_planes_is_refused) {
  BOOST_TEST(problem_of(kCamera + kGrey) == "a.dat: nothing to draw (no sphere and no plane)");
  BOOST_TEST(problem_of(kCamera + kGrey + "TRI V0 0 0 0 V1 1 1 1 V2 0 1 0 grey\n") ==
             "a.dat: nothing to draw (no sphere and no plane; skipped 1 triangle)");
}

BOOST_AUTO_TEST_CASE(every_truncation_is_an_error) {
  const std::string text = kBegin + kCamera + kGrey + kBall + "LIGHT CENTER 0 0 0 RAD 0 COLOR 1 1 1\n" + kBall;
  BOOST_TEST(problem_of_text(text) == "a.dat:8:1: END_SCENE is missing (the file ends here) is the file complete?");
  for (std::size_t size = 0; size < text.size(); ++size) {
    BOOST_TEST(problem_of_text(text.substr(0, size)).starts_with("a.dat:"), "no error at length " << size);
  }
}

BOOST_AUTO_TEST_CASE(a_missing_file_is_missing) {
  const auto error = error_of([&] { read_tachyon(folder / "none.dat"); });
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST((error->kind() == ErrorKind::input_missing));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
