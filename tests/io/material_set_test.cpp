// SPDX-License-Identifier: BSD-3-Clause
#include "io/material_set.h"

#include <boost/test/unit_test.hpp>

namespace tessera::io {

using render::Material;
using render::MaterialIndex;

BOOST_AUTO_TEST_SUITE(MaterialSetOfAScene)

BOOST_AUTO_TEST_CASE(materials_are_found_by_name) {
  MaterialSet set;
  const auto gold = set.add("gold", {.color = {1, 0.75, 0.33}});
  const auto grey = set.add("grey", {});
  BOOST_TEST((set.find("gold") == gold));
  BOOST_TEST((set.find("grey") == grey));
  BOOST_TEST(!set.find("Gold"));
  BOOST_TEST((set[gold].color == render::Rgb{1, 0.75, 0.33}));
}

BOOST_AUTO_TEST_CASE(unknown_names_get_a_suggestion) {
  MaterialSet set;
  BOOST_TEST(set.unknown("gold") == "unknown material \"gold\" (there is no [material.NAME] in the scene)");
  set.add("gold", {});
  BOOST_TEST(set.unknown("glod") == "unknown material \"glod\", did you mean \"gold\"?");
  BOOST_TEST(set.unknown("velvet") == "unknown material \"velvet\"");
}

BOOST_AUTO_TEST_CASE(the_default_joins_once_and_only_when_asked_for) {
  MaterialSet set;
  set.add("gold", {.reflection = 0.5});
  BOOST_TEST(set.size() == 1u);
  const auto first = set.default_material();
  BOOST_TEST((set.default_material() == first));
  BOOST_TEST(set.size() == 2u);
  BOOST_TEST((set[first] == Material{}));
}

BOOST_AUTO_TEST_CASE(equal_pairs_of_base_and_color_share_a_material) {
  MaterialSet set;
  const auto shiny = set.add("shiny", {.specular = 0.5});
  const auto matt = set.add("matt", {});
  const auto red = set.colored(shiny, {1, 0, 0});
  BOOST_TEST((set.colored(shiny, {1, -0.0, 0.0}) == red));
  BOOST_TEST((set.colored(matt, {1, 0, 0}) != red));
  BOOST_TEST((set.colored(shiny, {0, 1, 0}) != red));
  BOOST_TEST(set.size() == 5u);
  BOOST_TEST((set[red] == Material{.color = {1, 0, 0}, .specular = 0.5}));
}

BOOST_AUTO_TEST_CASE(a_color_that_the_base_has_needs_no_new_material) {
  MaterialSet set;
  const auto grey = set.default_material();
  BOOST_TEST((set.colored(grey, {0.8, 0.8, 0.8}) == grey));
  BOOST_TEST(set.size() == 1u);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
