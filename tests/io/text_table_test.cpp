// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_table.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <string_view>

#include "io/temp_folder.h"

namespace tessera::io {

using render::MaterialIndex;
using render::Rgb;
using render::Vec3;

namespace {

/// A table with the materials that a scene file may have given it.
struct Tables {
  MaterialSet materials;
  SphereTableOptions options;
  MaterialIndex gold = materials.add("gold", {.color = {1, 0.75, 0.33}, .specular = 0.5});

  SphereTable parse(std::string_view text) { return parse_text_table(text, "t.txt", options, materials); }

  std::string message(std::string_view text) {
    const auto error = test::error_of([&] { parse(text); });
    if (!error) return "no error";
    BOOST_TEST((error->kind() == ErrorKind::bad_scene));
    return error->what();
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(TextTable, Tables)

BOOST_AUTO_TEST_CASE(a_row_is_center_and_radius) {
  const auto spheres = parse("1 -2.5 3e2 0.5\n").spheres;
  BOOST_TEST_REQUIRE(spheres.size() == 1u);
  BOOST_TEST((spheres[0].center == Vec3{1, -2.5, 300}));
  BOOST_TEST(spheres[0].radius == 0.5);
  BOOST_TEST((materials[spheres[0].material] == render::Material{}));
}

BOOST_AUTO_TEST_CASE(numbers_are_read_to_the_last_bit) {
  const auto sphere = parse("0.1 +.5 -1.7976931348623157e151 4.9406564584124654e-151").spheres.at(0);
  BOOST_TEST(sphere.center.x == 0.1);
  BOOST_TEST(sphere.center.y == 0.5);
  BOOST_TEST(sphere.center.z == -1.7976931348623157e151);
  BOOST_TEST(sphere.radius == 4.9406564584124654e-151);
}

BOOST_AUTO_TEST_CASE(blanks_tabs_and_commas_separate) {
  for (const char* text : {"1 2 3 4", "1,2,3,4", "1, 2, 3, 4", "\t1\t2\t3\t4\t", "  1 ,2 ,3 , 4  ", "1\t, 2,\t3 4"}) {
    const auto spheres = parse(text).spheres;
    BOOST_TEST_REQUIRE(spheres.size() == 1u, text);
    BOOST_TEST((spheres[0].center == Vec3{1, 2, 3}), text);
    BOOST_TEST(spheres[0].radius == 4, text);
  }
}

BOOST_AUTO_TEST_CASE(comments_and_blank_lines_are_skipped_and_any_line_end_will_do) {
  BOOST_TEST(parse("# four spheres\n\n1 2 3 4\n   \n  # more\n1 2 3 4 # here too\n1 2 3 4#\n1 2 3 4").spheres.size() ==
             4u);
  BOOST_TEST(parse("# four spheres\r\n\r\n1 2 3 4\r\n1 2 3 4\r\n1 2 3 4\r\n1 2 3 4\r\n").spheres.size() == 4u);
  BOOST_TEST(parse("\xef\xbb\xbf"
                   "1 2 3 4")
                 .spheres.size() == 1u);
}

BOOST_AUTO_TEST_CASE(the_number_of_fields_tells_what_they_are) {
  const auto spheres = parse("1 2 3 4\n1 2 3 4 gold\n1 2 3 4 1 0 0\n1 2 3 4 1 0 0 gold\n").spheres;
  BOOST_TEST((materials[spheres[0].material] == render::Material{}));
  BOOST_TEST((spheres[1].material == gold));
  BOOST_TEST((materials[spheres[2].material] == render::Material{.color = {1, 0, 0}}));
  BOOST_TEST((materials[spheres[3].material] == render::Material{.color = {1, 0, 0}, .specular = 0.5}));
}

BOOST_AUTO_TEST_CASE(a_material_may_be_called_like_a_number) {
  const auto seven = materials.add("7", {});
  BOOST_TEST((parse("1 2 3 4 7").spheres.at(0).material == seven));
}

BOOST_AUTO_TEST_CASE(rows_without_a_material_take_that_of_the_table) {
  options.material = gold;
  const auto spheres = parse("1 2 3 4\n1 2 3 4 1 0 0\n").spheres;
  BOOST_TEST((spheres[0].material == gold));
  BOOST_TEST((materials[spheres[1].material] == render::Material{.color = {1, 0, 0}, .specular = 0.5}));
  BOOST_TEST(materials.size() == 2u);  // no default one
}

BOOST_AUTO_TEST_CASE(equal_colors_share_a_material) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "0 0 0 1 0." + std::to_string(i % 5) + " 0 1\n";
  BOOST_TEST(parse(text).spheres.size() == 1000u);
  BOOST_TEST(materials.size() == 2u + 5u);  // gold and the default one, and five colours
}

BOOST_AUTO_TEST_CASE(a_heading_names_the_columns_in_any_order_and_case) {
  for (const char* heading : {"material,blue,green,red,R,z,y,x", "Material Blue Green Red Radius Z Y X",
                              "\"material\",\"blue\",\"green\",\"red\",\"radius\",\"z\",\"y\",\"x\""}) {
    const auto table = parse(std::string("# a comment\n\n") + heading + "\ngold,0.3,0.2,0.1,4,3,2,1\n");
    BOOST_TEST_REQUIRE(table.spheres.size() == 1u);
    BOOST_TEST((table.spheres[0].center == Vec3{1, 2, 3}));
    BOOST_TEST(table.spheres[0].radius == 4);
    BOOST_TEST((materials[table.spheres[0].material] == render::Material{.color = {0.1, 0.2, 0.3}, .specular = 0.5}));
    BOOST_TEST(table.notes.empty());
  }
}

BOOST_AUTO_TEST_CASE(columns_of_other_names_are_left_out_and_noted) {
  const auto table = parse("id type x y z radius vx\n17 C6 1 2 3 4 nonsense\n");
  BOOST_TEST((table.spheres.at(0).center == Vec3{1, 2, 3}));
  BOOST_TEST(table.spheres.at(0).radius == 4);
  BOOST_TEST_REQUIRE(table.notes.size() == 1u);
  BOOST_TEST(table.notes[0] == "t.txt: columns not used: id, type, vx");
}

BOOST_AUTO_TEST_CASE(columns_may_be_given_with_the_table) {
  options.columns = {{"r", {}}, {"x", {}}, {"y", {}}, {"z", {}}, {"charge", {}}};
  const auto table = parse("4 1 2 3 -1\n");
  BOOST_TEST((table.spheres.at(0).center == Vec3{1, 2, 3}));
  BOOST_TEST(table.spheres.at(0).radius == 4);
  BOOST_TEST(table.notes.empty());  // who names them knows
}

BOOST_AUTO_TEST_CASE(bad_headings_are_refused_with_their_place) {
  BOOST_TEST(message("x y radious z\n") == "t.txt:1:5: unknown column \"radious\", did you mean \"radius\"?");
  BOOST_TEST(message("\n x y z\n") ==
             "t.txt:2:2: no column \"radius\" (columns are named, so x, y, z and radius must be)");
  BOOST_TEST(message("x,y,z,r,X\n") == "t.txt:1:9: column \"x\" is there twice");
  BOOST_TEST(message("x,y,z,r,radius\n") == "t.txt:1:9: column \"radius\" is there twice");
  BOOST_TEST(message("x,y,z,r,red,blue\n") == "t.txt:1:1: a colour needs all of the columns red, green and blue");
}

BOOST_AUTO_TEST_CASE(bad_rows_are_refused_with_their_place) {
  BOOST_TEST(message("1 2 3 4\n1 2 x 4\n") == "t.txt:2:5: z must be a number (found \"x\")");
  BOOST_TEST(message("1 2 3 4\nx 2 3 4\n") == "t.txt:2:1: x must be a number (found \"x\")");
  BOOST_TEST(message("1 2 3 4.5.6\n") == "t.txt:1:7: radius must be a number (found \"4.5.6\")");
  BOOST_TEST(message("1 2 3 0x10\n") == "t.txt:1:7: radius must be a number (found \"0x10\")");
  BOOST_TEST(message("1 2 3 +-1\n") == "t.txt:1:7: radius must be a number (found \"+-1\")");
  BOOST_TEST(message("1,2,,4\n") == "t.txt:1:5: z must be a number (found \"\")");
  BOOST_TEST(message("1,2,3,4,\n").starts_with("t.txt:1:9: unknown material \"\""));
  BOOST_TEST(message("1 2 nan 4\n") == "t.txt:1:5: z must be finite (found \"nan\")");
  BOOST_TEST(message("nan 2 3 4\n") == "t.txt:1:1: x must be finite (found \"nan\")");
  BOOST_TEST(message("1 2 3 inf\n") == "t.txt:1:7: radius must be finite (found \"inf\")");
  BOOST_TEST(message("1 1e999 3 4\n") == "t.txt:1:3: y is out of range (found \"1e999\")");
  BOOST_TEST(message("\r\n1 2 3 -1\r\n") == "t.txt:2:7: radius must be >= 0 (it is -1)");
  BOOST_TEST(message("1 2 3 4 0 -1 0\n") == "t.txt:1:9: color must be >= 0 (it is -1)");
  BOOST_TEST(message("1 2 3 4\n1 2 3 4 glod\n") == "t.txt:2:9: unknown material \"glod\", did you mean \"gold\"?");
}

BOOST_AUTO_TEST_CASE(rows_of_another_length_are_refused) {
  const std::string rule = "a row must have 4, 5, 7 or 8 fields (x y z r [r g b] [material]), found ";
  BOOST_TEST(message("1 2 3\n") == "t.txt:1:1: " + rule + "3");
  BOOST_TEST(message("  1 2 3 4 5 6\n") == "t.txt:1:3: " + rule + "6");
  BOOST_TEST(message("1 2 3 4 5 6 7 gold 9\n") == "t.txt:1:1: " + rule + "9");
  BOOST_TEST(message("x y z r\n1 2 3 4 5\n") == "t.txt:2:1: a row must have 4 fields, found 5");
}

BOOST_AUTO_TEST_CASE(a_table_without_spheres_is_refused) {
  for (const char* text : {"", "\n", "# nothing\n", "x y z r\n"}) {
    BOOST_TEST(message(text) == "t.txt: no spheres in the table", text);
  }
}

BOOST_AUTO_TEST_CASE(junk_is_refused_in_one_line) {
  const std::string junk(
      "\0\1\2\xff\n\n\x7f"
      "ELF 1 2 3",
      16);
  const std::string text = message(junk);
  BOOST_TEST(text.starts_with("t.txt:1:1: "));
  BOOST_TEST(text.find('\n') == std::string::npos);
  BOOST_TEST(message(std::string(1'000'000, '7')).size() < 200u);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
