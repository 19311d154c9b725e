// SPDX-License-Identifier: BSD-3-Clause
#include "io/place.h"

#include <boost/test/unit_test.hpp>
#include <string>

#include "io/temp_folder.h"

namespace tessera::io {

BOOST_AUTO_TEST_SUITE(PlaceInFile)

BOOST_AUTO_TEST_CASE(refusing_names_file_line_and_column) {
  const auto error = test::error_of([] { refuse({"a.toml", 12, 7}, "radius must be >= 0 (it is -1)"); });
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST((error->kind() == ErrorKind::bad_scene));
  BOOST_TEST(error->what() == std::string("a.toml:12:7: radius must be >= 0 (it is -1)"));
}

BOOST_AUTO_TEST_CASE(a_problem_is_one_line) {
  const auto error = test::error_of([] { refuse({"a.toml", 1, 2}, "saw 't\n'"); });
  BOOST_TEST(error.value().what() == std::string("a.toml:1:2: saw 't?'"));
}

BOOST_AUTO_TEST_CASE(quoted_words_stay_on_one_line_and_short) {
  BOOST_TEST(in_quotes("gold") == "\"gold\"");
  BOOST_TEST(in_quotes("") == "\"\"");
  BOOST_TEST(in_quotes("größe") == "\"größe\"");
  BOOST_TEST(in_quotes(std::string("a\nb\0c\x7f", 6)) == "\"a?b?c?\"");
  BOOST_TEST(in_quotes(std::string(41, 'x')) == "\"" + std::string(40, 'x') + "...\"");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
