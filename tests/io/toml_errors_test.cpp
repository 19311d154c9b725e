// SPDX-License-Identifier: BSD-3-Clause
// What the reader of scene files says about bad ones: each error has the place of the value that is wrong.
#include <boost/test/unit_test.hpp>
#include <string>
#include <string_view>

#include "io/temp_folder.h"
#include "io/toml_scene.h"

namespace tessera::io {

namespace {

struct Scenes {
  test::TempFolder folder;
  ErrorKind kind = ErrorKind::bad_scene;

  /// What the error says after the path of the folder: "s.toml:line:column: …".
  std::string message(std::string_view text) {
    const auto path = folder.write("s.toml", text);
    const auto error = test::error_of([&] { read_toml_scene(path); });
    if (!error) return "no error";
    BOOST_TEST((error->kind() == kind));
    const std::string what = error->what();
    BOOST_TEST(what.find('\n') == std::string::npos);
    const std::string prefix = path.parent_path().string() + "/";
    return what.starts_with(prefix) ? what.substr(prefix.size()) : what;
  }
};

const std::string kMaterials = "[material.gold]\n[material.grey]\n";            // two lines
const std::string kCamera = "[camera]\neye = [1, 1, 1]\ntarget = [0, 0, 0]\n";  // three lines

}  // namespace

BOOST_FIXTURE_TEST_SUITE(TomlErrors, Scenes)

BOOST_AUTO_TEST_CASE(unknown_keys_get_a_suggestion_or_the_list_of_known_ones) {
  BOOST_TEST(message("[[sphere]]\ncenter = [0, 0, 0]\nradious = 1") ==
             "s.toml:3:1: unknown key \"radious\" in [[sphere]], did you mean \"radius\"?");
  BOOST_TEST(message("[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nzebra = 1") ==
             "s.toml:4:1: unknown key \"zebra\" in [[sphere]] (known: center, radius, material)");
  BOOST_TEST(message("[imgae]\nwidth = 1") ==
             "s.toml:1:2: unknown key \"imgae\" in the scene file, did you mean \"image\"?");
  BOOST_TEST(message("[image]\n  widht = 1") ==
             "s.toml:2:3: unknown key \"widht\" in [image], did you mean \"width\"?");
  BOOST_TEST(message("[camera]\neye = [1, 1, 1]\nfow = 3") ==
             "s.toml:3:1: unknown key \"fow\" in [camera], did you mean \"fov\"?");
  BOOST_TEST(message("[environment]\nbackgound = [1, 1, 1]") ==
             "s.toml:2:1: unknown key \"backgound\" in [environment], did you mean \"background\"?");
  BOOST_TEST(message("[[light]]\nposition = [1, 1, 1]\ncolour = [1, 1, 1]") ==
             "s.toml:3:1: unknown key \"colour\" in [[light]], did you mean \"color\"?");
  BOOST_TEST(message("[material.gold]\nreflexion = 1") ==
             "s.toml:2:1: unknown key \"reflexion\" in [material.gold], did you mean \"reflection\"?");
  BOOST_TEST(message("[[plane]]\nchecker_sise = 1") ==
             "s.toml:2:1: unknown key \"checker_sise\" in [[plane]], did you mean \"checker_size\"?");
  BOOST_TEST(message("[[spheres]]\nflie = \"a\"") ==
             "s.toml:2:1: unknown key \"flie\" in [[spheres]], did you mean \"file\"?");
  BOOST_TEST(message("[generate]\nkind = \"cloud\"\nsead = 1") ==
             "s.toml:3:1: unknown key \"sead\" in [generate], did you mean \"seed\"?");
}

BOOST_AUTO_TEST_CASE(missing_keys_are_refused_at_their_table) {
  BOOST_TEST(message("\n  [[sphere]]\ncenter = [0, 0, 0]") == "s.toml:2:3: missing key \"radius\" in [[sphere]]");
  BOOST_TEST(message("[[sphere]]\nradius = 1") == "s.toml:1:1: missing key \"center\" in [[sphere]]");
  BOOST_TEST(message("[camera]\nfov = 30") == "s.toml:1:1: missing key \"eye\" in [camera]");
  BOOST_TEST(message("[[plane]]\nnormal = [0, 0, 1]") == "s.toml:1:1: missing key \"point\" in [[plane]]");
  BOOST_TEST(message("[[plane]]\npoint = [0, 0, 1]") == "s.toml:1:1: missing key \"normal\" in [[plane]]");
  BOOST_TEST(message("[[light]]\ncolor = [0, 0, 1]") ==
             "s.toml:1:1: missing key \"position\" or \"direction\" in [[light]]");
  BOOST_TEST(message("[[spheres]]\nmaterial = \"a\"") == "s.toml:1:1: missing key \"file\" in [[spheres]]");
  BOOST_TEST(message("[generate]\nlevel = 2") == "s.toml:1:1: missing key \"kind\" in [generate]");
}

BOOST_AUTO_TEST_CASE(wrong_types_say_what_was_expected_and_found) {
  const std::string sphere = "[[sphere]]\ncenter = [0, 0, 0]\n";
  BOOST_TEST(message(sphere + "radius = \"1\"") == "s.toml:3:10: radius must be a number (found \"1\")");
  BOOST_TEST(message(sphere + "radius = true") == "s.toml:3:10: radius must be a number (found true)");
  BOOST_TEST(message(sphere + "radius = [1]") == "s.toml:3:10: radius must be a number (found an array of 1)");
  BOOST_TEST(message(sphere + "radius = {a = 1}") == "s.toml:3:10: radius must be a number (found a table)");
  BOOST_TEST(message(sphere + "radius = 2020-01-01") == "s.toml:3:10: radius must be a number (found a date or time)");
  BOOST_TEST(message(sphere + "radius = 1\nmaterial = 3") == "s.toml:4:12: material must be a string (found 3)");
  BOOST_TEST(message("[[sphere]]\ncenter = 1") == "s.toml:2:10: center must be [x, y, z] (found 1)");
  BOOST_TEST(message("[[sphere]]\ncenter = [1, 2]") == "s.toml:2:10: center must be [x, y, z] (found an array of 2)");
  BOOST_TEST(message("[[sphere]]\ncenter = [1,\n  2, \"c\"]") ==
             "s.toml:3:6: each of center must be a number (found \"c\")");
  BOOST_TEST(message("[image]\nwidth = 1.5") == "s.toml:2:9: width must be a whole number >= 0 (found 1.5)");
  BOOST_TEST(message("[image]\nwidth = -5") == "s.toml:2:9: width must be a whole number >= 0 (found -5)");
  BOOST_TEST(message("[image]\nwidth = 4294967296") ==
             "s.toml:2:9: width must be at most 4294967295 (found 4294967296)");
  BOOST_TEST(message("[material.a]\ncolor = 1") == "s.toml:2:9: color must be \"#rrggbb\" or [r, g, b] (found 1)");
  BOOST_TEST(message("[material.a]\ncolor = \"red\"") ==
             "s.toml:2:9: color must be \"#rrggbb\" or [r, g, b] (found \"red\")");
  BOOST_TEST(message("[material.a]\ncolor = \"#12345g\"") ==
             "s.toml:2:9: color must be \"#rrggbb\" or [r, g, b] (found \"#12345g\")");
  BOOST_TEST(message("[material.a]\ncolor = [1, 2, true]") ==
             "s.toml:2:16: each of color must be a number (found true)");
  BOOST_TEST(message("[[spheres]]\nfile = 3") == "s.toml:2:8: file must be a string (found 3)");
  BOOST_TEST(message("[[spheres]]\nfile = \"a\"\ncolumns = \"x\"") ==
             "s.toml:3:11: columns must be an array of strings (found \"x\")");
  BOOST_TEST(message("[[spheres]]\nfile = \"a\"\ncolumns = []") ==
             "s.toml:3:11: columns must be an array of strings (found an array of 0)");
  BOOST_TEST(message("[generate]\nkind = \"cloud\"\nmaterials = []") ==
             "s.toml:3:13: materials must be an array of strings (found an array of 0)");
  BOOST_TEST(message("[[spheres]]\nfile = \"a\"\ncolumns = [\"x\", 1]") ==
             "s.toml:3:17: each of columns must be a string (found 1)");
}

BOOST_AUTO_TEST_CASE(wrong_kinds_of_table_are_refused) {
  BOOST_TEST(message("image = 3") == "s.toml:1:9: image must be a table [image] (found 3)");
  BOOST_TEST(message("[[image]]\nwidth = 3") == "s.toml:1:1: image must be a table [image] (found an array of 1)");
  BOOST_TEST(message("[sphere]\nradius = 3") ==
             "s.toml:1:1: sphere must be an array of tables [[sphere]] (found a table)");
  BOOST_TEST(message("sphere = [1]") == "s.toml:1:11: each of sphere must be a table [[sphere]] (found 1)");
  BOOST_TEST(message("material = 1") == "s.toml:1:12: material must be tables [material.NAME] (found 1)");
  BOOST_TEST(message("[material]\ngold = 1") == "s.toml:2:8: material.gold must be a table [material.gold] (found 1)");
}

BOOST_AUTO_TEST_CASE(numbers_that_are_not_finite_are_refused) {
  BOOST_TEST(message("[[sphere]]\ncenter = [0, nan, 0]") == "s.toml:2:14: each of center must be finite (found nan)");
  BOOST_TEST(message("[[sphere]]\ncenter = [0, 0, 0]\nradius = inf") ==
             "s.toml:3:10: radius must be finite (found inf)");
  BOOST_TEST(message("[[light]]\nposition = [0, 0, 0]\nintensity = -inf") ==
             "s.toml:3:13: intensity must be finite (found -inf)");
  BOOST_TEST(message("[environment]\nbackground = [nan, 0, 0]") ==
             "s.toml:2:15: each of background must be finite (found nan)");
}

BOOST_AUTO_TEST_CASE(what_cannot_be_rendered_is_refused_at_its_value) {
  BOOST_TEST(message("[image]\nwidth = 0") == "s.toml:2:9: width must be 1 to 65536 (it is 0)");
  BOOST_TEST(message("[image]\nwidth = 5\nheight = 0") == "s.toml:3:10: height must be 1 to 65536 (it is 0)");
  BOOST_TEST(message("[image]\nsamples = 5").starts_with("s.toml:2:11: samples must be a square number (it is 5)"));
  BOOST_TEST(message("[image]\nsamples = 5").find("4 or 9") != std::string::npos);
  BOOST_TEST(
      message("[camera]\neye = [1, 1, 1]\ntarget = [1, 1, 1]").starts_with("s.toml:2:7: eye and target are the same"));
  BOOST_TEST(message(kCamera + "up = [2, 2, 2]").starts_with("s.toml:4:6: up is parallel"));
  BOOST_TEST(message(kCamera + "up = [0, 0, 0]").starts_with("s.toml:4:6: up must not be zero"));
  BOOST_TEST(message(kCamera + "fov = 180").starts_with("s.toml:4:7: fov must be in (0, 180)"));
  BOOST_TEST(message(kCamera + "height = 0").starts_with("s.toml:4:10: height must be > 0"));
  BOOST_TEST(message("[environment]\nambient = [0, -1, 0]").starts_with("s.toml:2:11: ambient must be"));
  BOOST_TEST(message("[[light]]\ndirection = [0, 0, 0]").starts_with("s.toml:2:13: direction must not be zero"));
  BOOST_TEST(message("[[light]]\nposition = [0, 0, 0]\ncolor = [0, -1, 0]").starts_with("s.toml:3:9: color must be"));
  BOOST_TEST(message("[[light]]\nposition = [0, 0, 0]\nintensity = -1") ==
             "s.toml:3:13: intensity must be >= 0 (found -1)");
  BOOST_TEST(message("[[light]]\nposition = [0, 0, 0]\ncolor = [-1, -1, -1]\nintensity = -1")
                 .starts_with("s.toml:3:9: color must be"));
  BOOST_TEST(message("[[light]]\nposition = [0, 0, 0]\ncolor = [1e20, 0, 0]\nintensity = 1e20") ==
             "s.toml:4:13: intensity times color is out of range");
  BOOST_TEST(message("[material.a]\nreflection = 1.5") == "s.toml:2:14: reflection must be in [0, 1] (it is 1.5)");
  for (const char* key : {"ambient", "diffuse", "specular", "shininess"}) {
    const std::string name(key);
    const auto place = "s.toml:2:" + std::to_string(name.size() + 4) + ": ";
    BOOST_TEST(message("[material.a]\n" + name + " = -1") == place + name + " must be >= 0 (it is -1)");
  }
  BOOST_TEST(message("[[sphere]]\ncenter = [0, 0, 0]\nradius = -1") == "s.toml:3:10: radius must be >= 0 (it is -1)");
  BOOST_TEST(message("[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 0]").starts_with("s.toml:3:10: normal must not"));
  BOOST_TEST(message(kMaterials + "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nchecker_material = \"gold\"\n"
                                  "checker_size = 0") == "s.toml:7:16: checker_size must be > 0 (it is 0)");
}

BOOST_AUTO_TEST_CASE(keys_that_exclude_or_need_each_other_are_checked) {
  BOOST_TEST(message(kCamera + "fov = 30\nheight = 2") ==
             "s.toml:5:10: height and fov exclude each other (height is for orthographic)");
  BOOST_TEST(message("[[light]]\nposition = [0, 0, 0]\ndirection = [0, 0, 1]") ==
             "s.toml:3:13: direction and position exclude each other");
  BOOST_TEST(message("[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nchecker_size = 1") ==
             "s.toml:4:16: checker_size needs a checker_material");
  BOOST_TEST(message(kMaterials + "[generate]\nkind = \"cloud\"\nmaterial = \"gold\"\nmaterials = [\"grey\"]") ==
             "s.toml:6:13: materials and material exclude each other");
}

BOOST_AUTO_TEST_CASE(words_that_are_no_choice_are_refused) {
  BOOST_TEST(message("[image]\ntransfer = \"sgrb\"") ==
             "s.toml:2:12: transfer must be \"srgb\" or \"none\" (found \"sgrb\"), did you mean \"srgb\"?");
  BOOST_TEST(message("[image]\nshade = 1") == "s.toml:2:9: shade must be \"phong\" or \"blinn\" (found 1)");
  BOOST_TEST(message(kCamera + "handedness = \"up\"") ==
             "s.toml:4:14: handedness must be \"right\" or \"left\" (found \"up\")");
  BOOST_TEST(message("[generate]\nkind = \"clod\"") ==
             "s.toml:2:8: kind must be \"sphereflake\" or \"cloud\" (found \"clod\"), did you mean \"cloud\"?");
}

BOOST_AUTO_TEST_CASE(other_formats_are_refused) {
  BOOST_TEST(message("format = 2") == "s.toml:1:10: format must be 1 (found 2)");
  BOOST_TEST(message("format = \"1\"") == "s.toml:1:10: format must be a whole number >= 0 (found \"1\")");
}

BOOST_AUTO_TEST_CASE(unknown_materials_get_a_suggestion) {
  const std::string hint = "unknown material \"glod\", did you mean \"gold\"?";
  BOOST_TEST(message(kMaterials + "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"glod\"") ==
             "s.toml:6:12: " + hint);
  BOOST_TEST(message(kMaterials + "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nmaterial = \"glod\"") ==
             "s.toml:6:12: " + hint);
  BOOST_TEST(message(kMaterials + "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nchecker_material = \"glod\"") ==
             "s.toml:6:20: " + hint);
  BOOST_TEST(message(kMaterials + "[[spheres]]\nfile = \"a.txt\"\nmaterial = \"glod\"") == "s.toml:5:12: " + hint);
  BOOST_TEST(message(kMaterials + "[generate]\nkind = \"cloud\"\nmaterials = [\"gold\", \"glod\"]") ==
             "s.toml:5:22: " + hint);
  BOOST_TEST(message("[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"gold\"") ==
             "s.toml:4:12: unknown material \"gold\" (there is no [material.NAME] in the scene)");
}

BOOST_AUTO_TEST_CASE(bounds_of_generated_scenes_are_checked) {
  const std::string flake = "[generate]\nkind = \"sphereflake\"\n";
  const std::string cloud = "[generate]\nkind = \"cloud\"\n";
  BOOST_TEST(message(flake + "level = 8") ==
             "s.toml:3:9: level must be 0 to 7, each has nine times the spheres (found 8)");
  BOOST_TEST(message(flake + "radius = 0") == "s.toml:3:10: radius must be > 0 (found 0)");
  BOOST_TEST(message(flake + "radius = 1e308") == "s.toml:3:10: radius is too large");
  BOOST_TEST(message(flake + "level = 0\ncount = 5")
                 .starts_with("s.toml:4:1: unknown key \"count\" in [generate] with kind = \"sphereflake\""));
  BOOST_TEST(message(cloud + "count = 0") == "s.toml:3:9: count must be 1 to 200000000 (found 0)");
  BOOST_TEST(message(cloud + "count = 200000001") == "s.toml:3:9: count must be 1 to 200000000 (found 200000001)");
  BOOST_TEST(message(cloud + "fill = 0") == "s.toml:3:8: fill must be > 0 (found 0)");
  BOOST_TEST(message(cloud + "scale = -1") == "s.toml:3:9: scale must be > 0 (found -1)");
  BOOST_TEST(message(cloud + "scale = 1e200\nfill = 1e200") == "s.toml:4:8: fill is too large");
  BOOST_TEST(message(cloud + "level = 4")
                 .starts_with("s.toml:3:1: unknown key \"level\" in [generate] with kind = \"cloud\""));
}

BOOST_AUTO_TEST_CASE(trouble_with_a_table_has_a_place) {
  folder.write("bad.txt", "1 2 3 4\n1 2 3 -4\n");
  BOOST_TEST(message("[[spheres]]\nfile = \"bad.txt\"") == "bad.txt:2:7: radius must be >= 0 (it is -4)");
  folder.write("bad.bin", std::string(40, '\0'));
  BOOST_TEST(message("[[spheres]]\nfile = \"bad.bin\"\ncolumns = [\"x\", \"y\", \"tall\", \"r\"]") ==
             "s.toml:3:12: no column \"z\" (columns are named, so x, y, z and radius must be)");
}

BOOST_AUTO_TEST_CASE(a_table_that_is_missing_is_said_to_be_at_its_place) {
  kind = ErrorKind::input_missing;
  const std::string missing = message("[[spheres]]\nfile = \"none.txt\"");
  BOOST_TEST(missing.starts_with("s.toml:2:8: "));
  BOOST_TEST(missing.ends_with("none.txt: cannot open (No such file or directory)"));
  BOOST_TEST(message("[[spheres]]\nfile = \".\"").starts_with("s.toml:2:8: "));
}

BOOST_AUTO_TEST_CASE(syntax_errors_have_their_place) {
  BOOST_TEST(message("format = 1\n[image\nwidth = 3").starts_with("s.toml:2:7: "));
  BOOST_TEST(message("a = \n").starts_with("s.toml:1:5: "));
  BOOST_TEST(message("format = 1\nformat = 1").starts_with("s.toml:2:10: "));
  BOOST_TEST(message("a = 1e400").starts_with("s.toml:1:"));
  BOOST_TEST(message("a = t\n") == "s.toml:1:6: Error while parsing boolean: expected 'true', saw 't?'");
  BOOST_TEST(message("\xff\xfe").starts_with("s.toml:1:1: "));
  BOOST_TEST(message(std::string("a = \"x\0y\"", 9)).starts_with("s.toml:1:"));
}

BOOST_AUTO_TEST_CASE(a_file_without_keys_is_refused) {
  BOOST_TEST(message("") == "s.toml: the scene file is empty");
  BOOST_TEST(message("# nothing\n\n") == "s.toml: the scene file is empty");
}

BOOST_AUTO_TEST_CASE(every_cut_off_scene_is_read_or_refused_in_one_line) {
  const std::string text = kMaterials + kCamera + "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"gold\"\n";
  for (std::size_t size = 1; size < text.size(); ++size) {
    const std::string what = message(text.substr(0, size));
    BOOST_TEST((what == "no error" || what.starts_with("s.toml:")), what);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
