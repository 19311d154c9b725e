// SPDX-License-Identifier: BSD-3-Clause
#include "io/generate.h"

#include <algorithm>
#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdint>
#include <set>

namespace tessera::io {

using render::MaterialIndex;
using render::Sphere;
using render::Vec3;

namespace {

std::vector<MaterialIndex> materials(std::uint32_t count) {
  std::vector<MaterialIndex> indices;
  for (std::uint32_t i = 0; i < count; ++i) indices.push_back(MaterialIndex{i});
  return indices;
}

/// FNV-1a over the bits of every coordinate and radius.
std::uint64_t hash_of(const std::vector<Sphere>& spheres) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const Sphere& s : spheres) {
    for (const double number : {s.center.x, s.center.y, s.center.z, s.radius}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 0x100000001b3;
    }
  }
  return hash;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(SphereflakeScene)

BOOST_AUTO_TEST_CASE(each_level_has_nine_times_the_spheres_of_the_one_before) {
  const std::size_t counts[] = {1, 10, 91, 820, 7'381, 66'430, 597'871};
  for (std::uint32_t level = 0; level <= 6; ++level) {
    BOOST_TEST(generate_sphereflake({.level = level, .materials = materials(1)}).size() == counts[level]);
  }
}

BOOST_AUTO_TEST_CASE(each_child_touches_its_parent_at_a_third_of_its_radius) {
  const auto flake = generate_sphereflake({.level = 5, .materials = materials(1)});
  BOOST_TEST((flake[0].center == Vec3{0, 0, 0}));
  BOOST_TEST(flake[0].radius == 0.5);
  double worst = 0;
  for (std::size_t i = 1; i < flake.size(); ++i) {
    const Sphere& parent = flake[(i - 1) / 9];
    BOOST_TEST_REQUIRE(flake[i].radius == parent.radius / 3);
    const double gap = length(flake[i].center - parent.center) - (parent.radius + flake[i].radius);
    worst = std::max(worst, std::abs(gap));
  }
  BOOST_TEST(worst < 1e-14);
}

BOOST_AUTO_TEST_CASE(siblings_and_grandparents_do_not_overlap) {
  const auto flake = generate_sphereflake({.level = 4, .materials = materials(1)});
  const auto gap = [&](std::size_t i, std::size_t j) {
    return length(flake[i].center - flake[j].center) - flake[i].radius - flake[j].radius;
  };
  for (std::size_t i = 1; i < flake.size(); ++i) {
    const std::size_t parent = (i - 1) / 9;
    for (std::size_t j = 9 * parent + 1; j < i; ++j) BOOST_TEST_REQUIRE(gap(i, j) > 0.1 * flake[i].radius);
    if (parent > 0) BOOST_TEST_REQUIRE(gap(i, (parent - 1) / 9) > 0);
  }
}

BOOST_AUTO_TEST_CASE(six_children_sit_on_the_equator_and_three_55_degrees_above) {
  const auto flake = generate_sphereflake({.level = 2, .materials = materials(1)});
  const double sin_55 = std::sin(55 * std::acos(-1.0) / 180);
  // The pole of the root is z, that of another sphere the direction from its parent
  for (const std::size_t parent : {0u, 1u, 5u, 7u, 9u}) {
    const Vec3 pole = parent == 0 ? Vec3{0, 0, 1} : normalized(flake[parent].center - flake[(parent - 1) / 9].center);
    for (std::size_t seat = 0; seat < 9; ++seat) {
      const Vec3 to_child = normalized(flake[9 * parent + 1 + seat].center - flake[parent].center);
      const double expected = seat < 6 ? 0 : sin_55;
      BOOST_TEST(std::abs(dot(to_child, pole) - expected) < 1e-14, "parent " << parent << " seat " << seat);
    }
    const auto cos_between = [&](std::size_t seat, std::size_t other) {
      const Vec3& center = flake[parent].center;
      const std::size_t first = 9 * parent + 1;
      return dot(normalized(flake[first + seat].center - center), normalized(flake[first + other].center - center));
    };
    // Neighbours on the equator are 60 degrees apart, the upper three 120 degrees of azimuth
    for (std::size_t seat = 0; seat < 6; ++seat) BOOST_TEST(std::abs(cos_between(seat, (seat + 1) % 6) - 0.5) < 1e-14);
    const double upper = sin_55 * sin_55 - 0.5 * (1 - sin_55 * sin_55);
    for (std::size_t seat = 0; seat < 3; ++seat) {
      BOOST_TEST(std::abs(cos_between(6 + seat, 6 + (seat + 1) % 3) - upper) < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(it_can_be_moved_and_scaled) {
  const auto flake = generate_sphereflake({.level = 1, .center = {1, 2, 3}, .radius = 3, .materials = materials(1)});
  BOOST_TEST((flake[0].center == Vec3{1, 2, 3}));
  BOOST_TEST(flake[0].radius == 3);
  BOOST_TEST((flake[1].center == Vec3{5, 2, 3}));
  BOOST_TEST(flake[1].radius == 1);
}

BOOST_AUTO_TEST_CASE(generations_take_the_materials_in_turn) {
  const auto flake = generate_sphereflake({.level = 3, .materials = materials(3)});
  for (const auto& [first, last, material] : {std::tuple{0u, 1u, 0u}, {1u, 10u, 1u}, {10u, 91u, 2u}, {91u, 820u, 0u}}) {
    for (std::size_t i = first; i < last; ++i) BOOST_TEST_REQUIRE((flake[i].material == MaterialIndex{material}));
  }
}

BOOST_AUTO_TEST_CASE(its_bits_are_the_same_on_every_machine) {
  BOOST_TEST(hash_of(generate_sphereflake({.level = 4, .materials = materials(1)})) == 0xbd68a8834de3c023u);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(CloudScene)

BOOST_AUTO_TEST_CASE(centers_fill_the_cube_and_radii_their_range_evenly) {
  const std::size_t n = 20'000;
  const double largest = 0.7 / std::cbrt(static_cast<double>(n));
  const auto cloud = generate_cloud({.count = n, .materials = materials(1)});
  BOOST_TEST_REQUIRE(cloud.size() == n);
  Vec3 mean;
  double mean_radius = 0;
  double smallest = 1;
  double biggest = 0;
  for (const Sphere& sphere : cloud) {
    for (int axis = 0; axis < 3; ++axis) BOOST_TEST_REQUIRE(std::abs(sphere.center[axis]) <= 1);
    mean = mean + sphere.center / static_cast<double>(n);
    mean_radius += sphere.radius / static_cast<double>(n);
    smallest = std::min(smallest, sphere.radius);
    biggest = std::max(biggest, sphere.radius);
  }
  BOOST_TEST(length(mean) < 0.02);  // 3 sigma of each axis is 0.012
  BOOST_TEST(std::abs(mean_radius / largest - 0.65) < 0.005);
  BOOST_TEST(smallest >= 0.3 * largest * (1 - 1e-14));
  BOOST_TEST(smallest < 0.301 * largest);
  BOOST_TEST(biggest <= largest * (1 + 1e-14));
  BOOST_TEST(biggest > 0.999 * largest);
}

BOOST_AUTO_TEST_CASE(radii_shrink_with_the_cube_root_of_the_count) {
  for (const std::uint64_t n : {1u, 2u, 10u, 1'000u, 99'999u, 1'000'000u}) {
    const auto first = generate_cloud({.count = n, .materials = materials(1)}).front();
    const auto alone = generate_cloud({.count = 1, .materials = materials(1)}).front();
    const double expected = alone.radius / std::cbrt(static_cast<double>(n));
    BOOST_TEST(std::abs(first.radius / expected - 1) < 1e-14, "n " << n);
  }
}

BOOST_AUTO_TEST_CASE(the_seed_and_nothing_else_decides) {
  const auto a = generate_cloud({.count = 1000, .seed = 7, .materials = materials(1)});
  const auto b = generate_cloud({.count = 1000, .seed = 7, .materials = materials(8)});
  const auto c = generate_cloud({.count = 1000, .seed = 8, .materials = materials(1)});
  BOOST_TEST(hash_of(a) == hash_of(b));
  BOOST_TEST(hash_of(a) != hash_of(c));
}

BOOST_AUTO_TEST_CASE(its_bits_are_the_same_on_every_machine) {
  const auto cloud = generate_cloud({.count = 10'000, .seed = 1, .materials = materials(1)});
  BOOST_TEST(cloud.front().center.x == -0.73224671197493474);
  BOOST_TEST(cloud.front().center.y == -0.72718592726760556);
  BOOST_TEST(cloud.front().center.z == -0.097570192310923787);
  BOOST_TEST(cloud.front().radius == 0.010225507087473416);
  BOOST_TEST(hash_of(cloud) == 0xe98958e921c3e821u);
}

BOOST_AUTO_TEST_CASE(every_material_is_picked_about_as_often) {
  const auto cloud = generate_cloud({.count = 8'000, .materials = materials(8)});
  std::vector<int> counts(8);
  for (const Sphere& sphere : cloud) ++counts.at(static_cast<std::size_t>(sphere.material));
  for (const int count : counts) BOOST_TEST(std::abs(count - 1000) < 150);  // 5 sigma
}

BOOST_AUTO_TEST_CASE(center_scale_and_fill_move_and_size_it) {
  const auto unit = generate_cloud({.count = 100, .materials = materials(1)});
  const auto moved =
      generate_cloud({.count = 100, .fill = 1.4, .center = {10, 20, 30}, .scale = 4, .materials = materials(1)});
  for (std::size_t i = 0; i < unit.size(); ++i) {
    BOOST_TEST((moved[i].center == Vec3{10, 20, 30} + 4 * unit[i].center));
    BOOST_TEST(std::abs(moved[i].radius / unit[i].radius - 8) < 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
