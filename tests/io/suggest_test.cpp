// SPDX-License-Identifier: BSD-3-Clause
#include "io/suggest.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

namespace tessera::io {

BOOST_AUTO_TEST_SUITE(Suggest)

BOOST_AUTO_TEST_CASE(distance_counts_edits_and_swaps_of_neighbours) {
  BOOST_TEST(edit_distance("", "") == 0u);
  BOOST_TEST(edit_distance("radius", "radius") == 0u);
  BOOST_TEST(edit_distance("", "abc") == 3u);
  BOOST_TEST(edit_distance("abc", "") == 3u);
  BOOST_TEST(edit_distance("radious", "radius") == 1u);
  BOOST_TEST(edit_distance("radus", "radius") == 1u);
  BOOST_TEST(edit_distance("gold", "bold") == 1u);
  BOOST_TEST(edit_distance("centre", "center") == 1u);
  BOOST_TEST(edit_distance("glod", "gold") == 1u);
  BOOST_TEST(edit_distance("ba", "ab") == 1u);
  BOOST_TEST(edit_distance("kitten", "sitting") == 3u);
  BOOST_TEST(edit_distance("ca", "abc") == 3u);  // no letter is edited twice
}

BOOST_AUTO_TEST_CASE(distance_is_symmetric) {
  const std::vector<std::string> words{"", "a", "ab", "ba", "abc", "radius", "raduis", "dynamic", "static-bands"};
  for (const auto& a : words) {
    for (const auto& b : words) BOOST_TEST(edit_distance(a, b) == edit_distance(b, a), a << " " << b);
  }
}

BOOST_AUTO_TEST_CASE(nearest_word_wins_and_of_equals_the_first) {
  BOOST_TEST(nearest_word("radious", {"center", "radius"}).value() == "radius");
  BOOST_TEST(nearest_word("cold", {"bold", "gold"}).value() == "bold");
  BOOST_TEST(nearest_word("gold", {"bold", "gold"}).value() == "gold");
}

BOOST_AUTO_TEST_CASE(case_does_not_matter) {
  BOOST_TEST(nearest_word("RADIUS", {"center", "radius"}).value() == "radius");
  BOOST_TEST(nearest_word("gold", {"GOLD"}).value() == "GOLD");
}

BOOST_AUTO_TEST_CASE(far_words_are_not_suggested) {
  BOOST_TEST(!nearest_word("zebra", {"center", "radius"}));
  BOOST_TEST(!nearest_word("q", {"x", "y"}));
  BOOST_TEST(!nearest_word("", {"x", "fov"}));
  BOOST_TEST(!nearest_word("radius", {}));
  BOOST_TEST(!nearest_word(std::string(100'000, 'a'), {std::string(100'000, 'a')}));
}

BOOST_AUTO_TEST_CASE(the_hint_ends_a_message) {
  BOOST_TEST(did_you_mean("radious", {"center", "radius"}) == ", did you mean \"radius\"?");
  BOOST_TEST(did_you_mean("zebra", {"center", "radius"}) == "");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
