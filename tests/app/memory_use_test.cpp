// SPDX-License-Identifier: BSD-3-Clause
#include "app/memory_use.h"

#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <vector>

#include "app/small_job.h"

namespace tessera::app {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;

/// 40 MB of spheres that nothing can hit, and so without a tree to speak of.
render::Scene large_scene() {
  render::SceneData data;
  data.spheres.resize(kMegabyte);
  data.materials.resize(1);
  return {data, render::Kernel::brute};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(memory_use)

BOOST_AUTO_TEST_CASE(a_scene_takes_its_spheres_materials_and_tree) {
  const render::Scene scene(test::small_scene(), render::Kernel::scalar);
  const std::uint64_t expected = 40 * sizeof(render::Sphere) + 3 * sizeof(render::Material) +
                                 scene.bvh().nodes().size_bytes() + scene.bvh().leaves().size_bytes();
  BOOST_TEST(memory_bytes(scene) == expected);
  const io::Stats::Memory one = memory_of(scene, {});
  BOOST_TEST(one.node_bytes == expected);
  BOOST_TEST(one.bytes_per_sphere == static_cast<double>(expected) / 40);
  const io::Stats::Memory three = memory_of(scene, {3, false});
  BOOST_TEST(three.node_bytes == 3 * expected);
  BOOST_TEST(three.bytes_per_sphere == one.bytes_per_sphere);
}

BOOST_AUTO_TEST_CASE(a_scene_without_spheres_has_none_to_count_by) {
  const render::Scene scene(render::SceneData{}, render::Kernel::scalar);
  BOOST_TEST(memory_of(scene, {}).bytes_per_sphere == 0);
}

BOOST_AUTO_TEST_CASE(what_is_written_to_becomes_private_memory) {
  const std::uint64_t before = private_bytes();
  const std::vector<char> memory(64 * kMegabyte, 'x');
  BOOST_TEST(private_bytes() > before + 60 * kMegabyte);
  BOOST_TEST(private_bytes() < before + 80 * kMegabyte);
}

// Only what ranks share is not in a rank's own memory.
BOOST_AUTO_TEST_CASE(a_ranks_own_copy_of_the_scene_is_not_counted_twice) {
  const render::Scene scene = large_scene();
  const std::uint64_t beside_shared = memory_of(scene, {1, true}).rank_bytes;
  const std::uint64_t beside_own = memory_of(scene, {2, false}).rank_bytes;
  BOOST_TEST(beside_shared > beside_own + 39 * kMegabyte);
  BOOST_TEST(beside_shared < beside_own + 42 * kMegabyte);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::app
