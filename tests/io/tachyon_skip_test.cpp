// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_skip.h"

#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <string>
#include <string_view>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using test::error_of;

const std::string kTexture =
    " TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY .5 PHONG METAL 1 PHONG_SIZE 2 COLOR 1 1 1 TEXFUNC 0";
const std::string kCorners = "V0 1 2 3 V1 1 2 3 V2 1 2 3";
const std::string kNormals = " N0 1 2 3 N1 1 2 3 N2 1 2 3";

struct Shape {
  std::string text;
  std::string note;
};

const Shape kShapes[] = {
    {"TRI " + kCorners + " name", "skipped 1 triangle"},
    {"stri " + kCorners + kNormals + kTexture, "skipped 1 triangle"},
    {"VCSTRI " + kCorners + kNormals +
         " C0 1 0 0 C1 0 1 0 C2 0 0 1 AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 PHONG PLASTIC 0 PHONG_SIZE 1 VCST",
     "skipped 1 triangle"},
    {"FCYLINDER BASE 1 2 3 APEX 4 5 6 RAD 7" + kTexture, "skipped 1 cylinder"},
    {"CYLINDER CENTER 1 2 3 AXIS 4 5 6 RAD 7 name", "skipped 1 infinite cylinder"},
    {"POLYCYLINDER POINTS 2 1 2 3 4 5 6 RAD 7 name", "skipped 1 polycylinder"},
    {"RING CENTER 1 2 3 NORMAL 4 5 6 INNER 7 OUTER 8 name", "skipped 1 ring"},
    {"BOX MIN 1 2 3 MAX 4 5 6" + kTexture, "skipped 1 box"},
    {"SCAPE RES 30 30 SCALE 80 80 CENTER 0 -4 20 name", "skipped 1 landscape"},
    {"SCALARVOL MIN 1 2 3 MAX 4 5 6 DIM 7 8 9 FILE a/b name", "skipped 1 volume"},
    {"TPOLYFILE SCALE 1 2 3 ROT 4 5 6 CENTER 7 8 9 FILE a/b name", "skipped 1 triangle file"},
    {"MGFFILE a/b", "skipped 1 MGF file"},
    {"IMAGEDEF ::a FORMAT RGB24 RESOLUTION 2 1 2 ENCODING HEX 000 f00 0f0 00f", ""},
    {"VERTEXARRAY NUMVERTS 2 COORDS 1 2 3 4 5 6 NORMALS 1 2 3 4 5 6 COLORS 1 2 3 4 5 6" + kTexture +
         " TRIMESH 2 0 1 0 1 0 1 TRISTRIP 5 0 1 0 1 0 END_VERTEXARRAY",
     "skipped 5 triangles"},
};

}  // namespace

BOOST_AUTO_TEST_SUITE(TachyonSkip)

BOOST_AUTO_TEST_CASE(every_shape_is_read_to_its_end_and_counted) {
  const test::TempFolder folder;
  for (const Shape& shape : kShapes) {
    TachyonTokens in(folder.write("a.dat", shape.text + " NEXT"));
    TachyonNotes notes;
    BOOST_TEST(skip_shape(in.next(), in, notes), shape.text);
    BOOST_TEST(in.next() == "NEXT", shape.text);
    BOOST_TEST(notes.skipped() == shape.note);
    BOOST_TEST(notes.lines().size() == (shape.note.empty() ? 0u : 1u));  // nothing about a texture that isn't drawn
  }
}

BOOST_AUTO_TEST_CASE(a_shape_that_ends_early_is_an_error) {
  const test::TempFolder folder;
  for (const Shape& shape : kShapes) {
    for (std::size_t end = shape.text.rfind(' '); end != std::string::npos && end > 0;
         end = shape.text.rfind(' ', end - 1)) {
      TachyonTokens in(folder.write("a.dat", shape.text.substr(0, end)));
      TachyonNotes notes;
      const auto error = error_of([&] { skip_shape(in.next(), in, notes); });
      BOOST_TEST_REQUIRE(error.has_value(), "no error after " << shape.text.substr(0, end));
      BOOST_TEST(std::string(error->what()).ends_with("(the file ends here)"), error->what());
    }
  }
}

BOOST_AUTO_TEST_CASE(other_keywords_are_left_alone) {
  const test::TempFolder folder;
  TachyonTokens in(folder.write("a.dat", "SPHERE CENTER"));
  TachyonNotes notes;
  BOOST_TEST(!skip_shape(in.next(), in, notes));
  BOOST_TEST(in.next() == "CENTER");
}

BOOST_AUTO_TEST_CASE(a_negative_count_is_refused) {
  const test::TempFolder folder;
  TachyonTokens in(folder.write("a.dat", "POLYCYLINDER POINTS -1 RAD 1 name"));
  TachyonNotes notes;
  const auto error = error_of([&] { skip_shape(in.next(), in, notes); });
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST(error->what() == (folder / "a.dat").string() + ":1:21: expected a count (found -1)");
}

BOOST_AUTO_TEST_CASE(notes_say_one_or_many) {
  TachyonNotes notes;
  notes.skip("cylinder", 22);
  notes.skip("box", 2);
  notes.skip("ring");
  notes.count(Inexact::opacity);
  notes.count(Inexact::spotlight);
  notes.count(Inexact::spotlight);
  const std::vector<std::string> expected{"skipped 2 boxes, 22 cylinders, 1 ring", "shining to all sides: 2 spotlights",
                                          "drawn as opaque: 1 texture with OPACITY < 1"};
  BOOST_TEST(notes.lines() == expected);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
