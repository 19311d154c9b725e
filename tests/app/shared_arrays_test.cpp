// SPDX-License-Identifier: BSD-3-Clause
#include "app/shared_arrays.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <vector>

#include "scheduler/mpi/session_for_tests.h"

namespace tessera::app {
namespace {

using render::Material;
using render::MaterialIndex;
using render::Sphere;
using scheduler::mpi::Session;
using scheduler::mpi::session_for_tests;
using scheduler::mpi::Sharing;

std::vector<Sphere> some_spheres(std::size_t count) {
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i != count; ++i) {
    const double x = static_cast<double>(i);
    spheres.push_back({{x, 0.1 * x, -x}, 1 / (1 + x), static_cast<MaterialIndex>(i % 5)});
  }
  return spheres;
}

std::vector<Material> some_materials(std::size_t count) {
  std::vector<Material> materials(count);
  for (std::size_t i = 0; i != count; ++i) materials[i].shininess = static_cast<double>(i);
  return materials;
}

SceneArrays share(std::size_t spheres, std::size_t materials, Sharing sharing) {
  Session& session = session_for_tests();
  if (session.rank() != scheduler::kMasterRank) return share_arrays(session, {}, {}, sharing);
  return share_arrays(session, some_spheres(spheres), some_materials(materials), sharing);
}

bool are_equal(const SceneArrays& arrays, const std::vector<Sphere>& spheres, const std::vector<Material>& materials) {
  const auto is_same = [](const Sphere& a, const Sphere& b) { return coincide(a, b) && a.material == b.material; };
  return std::equal(arrays.spheres.begin(), arrays.spheres.end(), spheres.begin(), spheres.end(), is_same) &&
         std::equal(arrays.materials.begin(), arrays.materials.end(), materials.begin(), materials.end());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(shared_arrays)

BOOST_AUTO_TEST_CASE(every_rank_has_what_rank_0_read) {
  for (const Sharing sharing : {Sharing::if_possible, Sharing::never}) {
    for (const std::size_t spheres : {0U, 1U, 40'001U}) {
      for (const std::size_t materials : {0U, 1U, 3'333U}) {
        const SceneArrays arrays = share(spheres, materials, sharing);
        BOOST_TEST(are_equal(arrays, some_spheres(spheres), some_materials(materials)), spheres << ", " << materials);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(copies_are_one_a_node_or_one_a_rank) {
  const std::uint32_t ranks = session_for_tests().ranks_on_node();
  const Copies apart = share(100, 1, Sharing::never).copies;
  BOOST_TEST(apart.on_node == ranks);
  BOOST_TEST(!apart.is_shared);
  const Copies together = share(100, 1, Sharing::if_possible).copies;
  BOOST_TEST(together.on_node == (together.is_shared ? 1 : ranks));
}

// Where memory is shared, what one rank of a node writes the others see: there is one copy.
BOOST_AUTO_TEST_CASE(ranks_of_a_node_look_at_the_same_memory) {
  Session& session = session_for_tests();
  const SceneArrays arrays = share(1000, 10, Sharing::if_possible);
  const bool is_shared = arrays.copies.is_shared;  // of rank 0 alone on its node it is not
  session.barrier();
  // Nobody but a test writes here
  if (is_shared && session.is_first_on_node()) const_cast<Sphere&>(arrays.spheres[999]).radius = 7 + session.rank();
  session.barrier();
  std::uint32_t first = session.rank();
  session.broadcast_on_node(std::as_writable_bytes(std::span(&first, 1)));
  if (is_shared) BOOST_TEST(arrays.spheres[999].radius == 7 + first);
}

BOOST_AUTO_TEST_CASE(arrays_outlive_those_of_other_ranks) {
  Session& session = session_for_tests();
  SceneArrays arrays = share(1000, 10, Sharing::if_possible);
  if (session.is_first_on_node()) arrays = {};
  session.barrier();
  BOOST_TEST((session.is_first_on_node() || are_equal(arrays, some_spheres(1000), some_materials(10))));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::app
