// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_tokens.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <string_view>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using test::error_of;

struct Fixture {
  test::TempFolder folder;

  TachyonTokens tokens(std::string_view text) const { return TachyonTokens(folder.write("a.dat", text)); }

  // What follows the file's name in the message.
  template <class Action>
  std::string problem_of(Action&& action) const {
    const auto error = error_of(action);
    if (!error) return "none";
    BOOST_TEST((error->kind() == ErrorKind::bad_scene));
    const std::string file = (folder / "a.dat").string() + ":";
    const std::string what = error->what();
    return what.starts_with(file) ? what.substr(file.size()) : what;
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(TachyonTokensTest, Fixture)

BOOST_AUTO_TEST_CASE(words_stand_between_blanks) {
  TachyonTokens in = tokens(" a\tb\r\nc\v\fd");
  for (const char* word : {"a", "b", "c", "d", "", ""}) BOOST_TEST(in.next() == word);
}

BOOST_AUTO_TEST_CASE(a_comment_begins_with_a_word_of_one_number_sign) {
  TachyonTokens in = tokens("# one\na # two # b\n#c d#\ne#\n#\nf #");
  for (const char* word : {"a", "#c", "d#", "e#", "f", ""}) BOOST_TEST(in.next() == word);
}

BOOST_AUTO_TEST_CASE(keywords_ignore_case) {
  TachyonTokens in = tokens("SPHERE sphere SpHeRe spherE_");
  for (int i = 0; i < 3; ++i) in.expect("SPHERE");
  BOOST_TEST(!in.take("SPHERE"));
  BOOST_TEST(in.take("SPHERE_"));
  BOOST_TEST(!in.take("SPHERE_"));
}

BOOST_AUTO_TEST_CASE(numbers_are_read_as_people_write_them) {
  TachyonTokens in = tokens("1 +2 -3 .5 4. +.25 1e3 -1.5E-2 +1e+1 1e-400 007");
  for (const double value : {1., 2., -3., .5, 4., .25, 1000., -.015, 10., 0., 7.}) BOOST_TEST(in.number() == value);
  TachyonTokens vectors = tokens("1 2 3 4 5 6");
  BOOST_TEST((vectors.vector() == render::Vec3{1, 2, 3}));
  BOOST_TEST((vectors.color() == render::Rgb{4, 5, 6}));
  TachyonTokens integers = tokens("+12 -7");
  BOOST_TEST(integers.integer() == 12);
  BOOST_TEST(integers.integer() == -7);
}

BOOST_AUTO_TEST_CASE(what_is_no_number_is_refused) {
  for (const std::string word : {"x", "1x", "0x10", "+-1", "++1", "+", "-", ".", "1,5", "1e"}) {
    TachyonTokens in = tokens(word);
    BOOST_TEST(problem_of([&] { in.number(); }) == "1:1: expected a number (found \"" + word + "\")");
  }
  for (const std::string word : {"nan", "inf", "-infinity", "1e400"}) {
    TachyonTokens in = tokens(word);
    BOOST_TEST(problem_of([&] { in.number(); }) == "1:1: number out of range (\"" + word + "\" is not finite)");
  }
  for (const std::string word : {"1.0", "1e3", "99999999999999999999"}) {
    TachyonTokens in = tokens(word);
    BOOST_TEST(problem_of([&] { in.integer(); }) == "1:1: expected a whole number (found \"" + word + "\")");
  }
}

BOOST_AUTO_TEST_CASE(errors_name_line_and_column) {
  TachyonTokens in = tokens("A\r\n# c\n  B c\n");
  in.expect("A");
  BOOST_TEST(problem_of([&] { in.expect("X"); }) == "3:3: expected X (found \"B\")");
  in.next();
  BOOST_TEST(problem_of([&] { in.fail("no"); }) == "3:5: no");
  BOOST_TEST(problem_of([&] { in.word("a name"); }) == "4:1: expected a name (the file ends here)");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
