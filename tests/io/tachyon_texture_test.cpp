// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_texture.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <string_view>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using test::error_of;

TachyonTexture read(std::string_view text) {
  const test::TempFolder folder;
  TachyonTokens in(folder.write("a.dat", std::string(text) + " NEXT"));
  const TachyonTexture texture = read_texture_body(in);
  in.expect("NEXT");
  return texture;
}

InexactSet only(Inexact what) {
  return InexactSet().set(static_cast<std::size_t>(what));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(TachyonTextureTest)

BOOST_AUTO_TEST_CASE(plain_weights_are_taken_as_they_are) {
  const TachyonTexture texture = read("Ambient 0.25 Diffuse 0.5 Specular 0 Opacity 1 Color 0.1 0.2 2.5 TexFunc 0");
  const render::Material expected{{0.1, 0.2, 2.5}, 0.25, 0.5, 0, 32, 0};
  BOOST_TEST((texture.material == expected));
  BOOST_TEST(texture.inexact.none());
}

BOOST_AUTO_TEST_CASE(phong_is_the_highlight) {
  const auto material =
      read("AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 PHONG PLASTIC 0.75 PHONG_SIZE 40 COLOR 1 1 1 TEXFUNC 0").material;
  BOOST_TEST(material.specular == 0.75);
  BOOST_TEST(material.shininess == 40);
}

BOOST_AUTO_TEST_CASE(added_mirror_becomes_a_mixed_one) {
  // Tachyon: 0.25 a + 0.5 d + 0.75 p + 0.5 m; ours: (1 - 0.5) (0.5 a + 1 d + 1.5 p) + 0.5 m
  const auto material =
      read("AMBIENT .25 DIFFUSE .5 SPECULAR .5 OPACITY 1 PHONG PLASTIC .75 PHONG_SIZE 9 COLOR 1 1 1 TEXFUNC 0")
          .material;
  const render::Material expected{{1, 1, 1}, 0.5, 1, 1.5, 9, 0.5};
  BOOST_TEST((material == expected));
}

BOOST_AUTO_TEST_CASE(a_full_mirror_loses_its_local_terms) {
  const TachyonTexture pure = read("AMBIENT 0 DIFFUSE 0 SPECULAR 1 OPACITY 1 COLOR 1 1 1 TEXFUNC 0");
  BOOST_TEST(pure.material.reflection == 1);
  BOOST_TEST(pure.inexact.none());
  const TachyonTexture mixed = read("AMBIENT 0 DIFFUSE .1 SPECULAR 1 OPACITY 1 COLOR 1 1 1 TEXFUNC 0");
  BOOST_TEST(mixed.material.reflection == 1);
  BOOST_TEST((mixed.inexact == only(Inexact::local_terms_lost)));
}

BOOST_AUTO_TEST_CASE(specular_is_clamped) {
  const TachyonTexture high = read("AMBIENT 0 DIFFUSE 0 SPECULAR 1.5 OPACITY 1 COLOR 1 1 1 TEXFUNC 0");
  BOOST_TEST(high.material.reflection == 1);
  BOOST_TEST((high.inexact == only(Inexact::specular_out_of_range)));
  BOOST_TEST(read("AMBIENT 0 DIFFUSE 0 SPECULAR -2 OPACITY 1 COLOR 1 1 1 TEXFUNC 0").material.reflection == 0);
}

BOOST_AUTO_TEST_CASE(what_we_draw_in_another_way_is_marked) {
  BOOST_TEST(
      (read("AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 0.5 COLOR 1 1 1 TEXFUNC 0").inexact == only(Inexact::opacity)));
  BOOST_TEST(
      (read("AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 PHONG METAL 1 PHONG_SIZE 9 COLOR 1 1 1 TEXFUNC 0").inexact ==
       only(Inexact::metal)));
  BOOST_TEST((read("AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 TRANSMODE R3D OUTLINE 1 OUTLINE_WIDTH .5 COLOR 1 1 1 "
                   "TEXFUNC 0")
                  .inexact == only(Inexact::outline)));
}

BOOST_AUTO_TEST_CASE(every_texture_function_is_read_past) {
  const std::string body = "AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 0 0 TEXFUNC ";
  const std::string placed = " CENTER 0 0 0 ROTATE 0 0 0 SCALE 1 1 1";
  for (const std::string& function : {"1" + placed, "6" + placed, "7 a.ppm" + placed, "8 a.ppm" + placed,
                                      "9 a.ppm" + placed + " UAXIS 1 0 0 VAXIS 0 1 0",
                                      "10 ::a" + placed + " UAXIS 1 0 0 VAXIS 0 1 0 WAXIS 0 0 1", std::string("11")}) {
    const TachyonTexture texture = read(body + function);
    BOOST_TEST((texture.material.color == render::Rgb{1, 0, 0}));
    BOOST_TEST((texture.inexact == only(Inexact::texfunc)));
  }
}

BOOST_AUTO_TEST_CASE(bad_textures_are_refused_with_their_place) {
  const auto problem_of = [](std::string_view text) {
    const auto error = error_of([&] { read(text); });
    const std::string what = error ? error->what() : "none";
    return what.substr(what.find("a.dat:") + 6);
  };
  BOOST_TEST(problem_of("DIFFUSE 1") == "1:1: expected AMBIENT (found \"DIFFUSE\")");
  BOOST_TEST(problem_of("AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1\nPHONG STONE 1") ==
             "2:7: expected METAL or PLASTIC (found \"STONE\")");
  BOOST_TEST(problem_of("AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 TEXFUNC 0") ==
             "1:42: expected COLOR (found \"TEXFUNC\")");
  BOOST_TEST(problem_of("\n AMBIENT -1 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0")
                 .starts_with("2:2: ambient must be"));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
