// SPDX-License-Identifier: BSD-3-Clause
#include "app/shared_tree.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <span>
#include <vector>

#include "render/bvh_build.h"
#include "scheduler/mpi/session_for_tests.h"

namespace tessera::app {
namespace {

using render::MaterialIndex;
using render::Sphere;
using scheduler::mpi::session_for_tests;
using scheduler::mpi::Sharing;

std::vector<Sphere> some_spheres(std::size_t count) {
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i != count; ++i) {
    const auto coordinate = [&](std::size_t step) { return static_cast<double>(i * step % 1009); };
    spheres.push_back({{coordinate(1), coordinate(31), coordinate(577)}, 3, MaterialIndex{0}});
  }
  return spheres;
}

template <class T>
bool same_bytes(std::span<const T> a, std::span<const T> b) {
  return std::ranges::equal(std::as_bytes(a), std::as_bytes(b));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(shared_tree)

BOOST_AUTO_TEST_CASE(the_tree_of_a_node_is_that_of_a_rank) {
  for (const std::size_t count : {0U, 1U, 9U, 20'000U}) {
    const std::vector<Sphere> spheres = some_spheres(count);
    const render::Bvh alone = render::build_bvh(spheres);
    for (const Sharing sharing : {Sharing::if_possible, Sharing::never}) {
      const render::Bvh together = build_on_node(session_for_tests(), spheres, sharing);
      BOOST_TEST(same_bytes(together.nodes(), alone.nodes()), count);
      BOOST_TEST(same_bytes(together.leaves(), alone.leaves()), count);
      BOOST_TEST((together.space().base == alone.space().base && together.space().scale == alone.space().scale));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::app
