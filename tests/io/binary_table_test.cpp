// SPDX-License-Identifier: BSD-3-Clause
#include "io/binary_table.h"

#include <bit>
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/temp_folder.h"

namespace tessera::io {

using render::Vec3;

namespace {

/// Little-endian float64, byte by byte.
std::string bytes_of(const std::vector<double>& numbers) {
  std::string bytes;
  for (const double number : numbers) {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>((bits >> shift) & 0xff);
  }
  return bytes;
}

std::vector<PlacedWord> columns(const std::vector<std::string>& names) {
  std::vector<PlacedWord> words;
  for (std::size_t i = 0; i < names.size(); ++i) words.push_back({names[i], {"s.toml", 3, 10 + i}});
  return words;
}

struct Tables {
  MaterialSet materials;
  SphereTableOptions options;

  SphereTable parse(const std::string& bytes) { return parse_binary_table(bytes, "t.bin", options, materials); }

  std::string message(const std::string& bytes) {
    const auto error = test::error_of([&] { parse(bytes); });
    if (!error) return "no error";
    BOOST_TEST((error->kind() == ErrorKind::bad_scene));
    return error->what();
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(BinaryTable, Tables)

BOOST_AUTO_TEST_CASE(rows_are_center_and_radius) {
  const auto spheres = parse(bytes_of({1, 2, 3, 0.5, -1e150, 0.1, -0.0, 0})).spheres;
  BOOST_TEST_REQUIRE(spheres.size() == 2u);
  BOOST_TEST((spheres[0].center == Vec3{1, 2, 3}));
  BOOST_TEST(spheres[0].radius == 0.5);
  BOOST_TEST((spheres[1].center == Vec3{-1e150, 0.1, 0}));
  BOOST_TEST(spheres[1].radius == 0);
  BOOST_TEST((materials[spheres[1].material] == render::Material{}));
}

BOOST_AUTO_TEST_CASE(columns_may_be_named_with_colors_and_others_among_them) {
  options.columns = columns({"id", "radius", "z", "y", "x", "red", "green", "blue"});
  options.material = materials.add("gold", {.specular = 0.5});
  const auto spheres = parse(bytes_of({99, 4, 3, 2, 1, 0.1, 0.2, 0.3, 99, 4, 3, 2, 1, 0.1, 0.2, 0.3})).spheres;
  BOOST_TEST_REQUIRE(spheres.size() == 2u);
  BOOST_TEST((spheres[1].center == Vec3{1, 2, 3}));
  BOOST_TEST(spheres[1].radius == 4);
  BOOST_TEST((materials[spheres[1].material] == render::Material{.color = {0.1, 0.2, 0.3}, .specular = 0.5}));
  BOOST_TEST(materials.size() == 2u);
}

BOOST_AUTO_TEST_CASE(an_unused_column_may_hold_anything) {
  options.columns = columns({"x", "y", "z", "r", "charge"});
  BOOST_TEST(parse(bytes_of({1, 2, 3, 4, std::numeric_limits<double>::quiet_NaN()})).spheres.size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_size_that_is_no_whole_number_of_rows_is_refused_with_the_figures) {
  BOOST_TEST(message(bytes_of({1, 2, 3, 4}) + "abc") ==
             "t.bin: 35 bytes are not a whole number of rows (4 columns make rows of 32 bytes, 3 bytes are left over)");
  options.columns = columns({"x", "y", "z", "r", "charge"});
  BOOST_TEST(
      message(bytes_of({1, 2, 3, 4})) ==
      "t.bin: 32 bytes are not a whole number of rows (5 columns make rows of 40 bytes, 32 bytes are left over)");
}

BOOST_AUTO_TEST_CASE(an_empty_file_is_refused) {
  BOOST_TEST(message("") == "t.bin: no spheres in the table");
}

BOOST_AUTO_TEST_CASE(bad_numbers_are_refused_with_their_row) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  BOOST_TEST(message(bytes_of({1, 2, 3, 4, 1, nan, 3, 4})) == "t.bin: row 2: y must be finite");
  BOOST_TEST(message(bytes_of({1, 2, 3, inf})) == "t.bin: row 1: radius must be finite");
  BOOST_TEST(message(bytes_of({1, 2, 3, -4})) == "t.bin: row 1: radius must be >= 0 (it is -4)");
  options.columns = columns({"x", "y", "z", "r", "red", "green", "blue"});
  BOOST_TEST(message(bytes_of({1, 2, 3, 4, 0, 0, -1})) == "t.bin: row 1: color must be >= 0 (it is -1)");
}

BOOST_AUTO_TEST_CASE(bad_columns_are_refused_where_they_are_named) {
  const std::string row = bytes_of({1, 2, 3, 4, 5});
  options.columns = columns({"x", "y", "z", "r", "material"});
  BOOST_TEST(message(row) == "s.toml:3:14: a binary table holds numbers only (no column \"material\")");
  options.columns = columns({"x", "y", "z", "gren", "r"});
  BOOST_TEST(message(row) == "s.toml:3:13: unknown column \"gren\", did you mean \"green\"?");
  options.columns = columns({"x", "y", "z", "mass", "id"});
  BOOST_TEST(message(row) == "s.toml:3:10: no column \"radius\" (columns are named, so x, y, z and radius must be)");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
