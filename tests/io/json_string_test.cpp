// SPDX-License-Identifier: BSD-3-Clause
#include "io/json_string.h"

#include <boost/test/unit_test.hpp>
#include <string>

namespace tessera::io {

BOOST_AUTO_TEST_SUITE(JsonString)

BOOST_AUTO_TEST_CASE(plain_text_is_quoted) {
  BOOST_TEST(json_string("") == "\"\"");
  BOOST_TEST(json_string("node-7.cluster") == "\"node-7.cluster\"");
}

BOOST_AUTO_TEST_CASE(quotes_backslashes_and_controls_are_escaped) {
  BOOST_TEST(json_string("a\"b\\c") == R"("a\"b\\c")");
  BOOST_TEST(json_string(std::string("\0\n\x1f\x7f", 4)) == R"("\u0000\u000a\u001f\u007f")");
}

BOOST_AUTO_TEST_CASE(characters_of_several_bytes_stay) {
  for (const std::string text :
       {"caf\u00e9", "\u20ac", "\U0001F600", "\u0800\uD7FF\uE000\uFFFF", "\U00010000\U0010FFFF"}) {
    BOOST_TEST(json_string(text) == "\"" + text + "\"");
  }
}

BOOST_AUTO_TEST_CASE(bytes_that_are_no_characters_are_replaced_one_by_one) {
  const std::string mark = "\uFFFD";
  BOOST_TEST(json_string("\x80") == "\"" + mark + "\"");                                   // a byte that only follows
  BOOST_TEST(json_string("\xc3") == "\"" + mark + "\"");                                   // cut off
  BOOST_TEST(json_string("caf\xc3x") == "\"caf" + mark + "x\"");                           // cut off by a letter
  BOOST_TEST(json_string("\xe2\x82") == "\"" + mark + mark + "\"");                        // cut off after two of three
  BOOST_TEST(json_string("\xf0\x9f\x98z") == "\"" + mark + mark + mark + "z\"");           // three of four
  BOOST_TEST(json_string("\xc0\xaf") == "\"" + mark + mark + "\"");                        // longer than need be
  BOOST_TEST(json_string("\xe0\x80\xaf") == "\"" + mark + mark + mark + "\"");             // the same
  BOOST_TEST(json_string("\xed\xa0\x80") == "\"" + mark + mark + mark + "\"");             // half of a pair
  BOOST_TEST(json_string("\xf4\x90\x80\x80") == "\"" + mark + mark + mark + mark + "\"");  // beyond the last one
  BOOST_TEST(json_string("\xff\"") == "\"" + mark + "\\\"\"");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
