// SPDX-License-Identifier: BSD-3-Clause
#include "render/lanes_avx2.h"

#include <array>
#include <boost/test/unit_test.hpp>

#include "render/kernel.h"

#if defined(__x86_64__)
using namespace tessera::render;

TESSERA_BEGIN_AVX2
namespace {

/// The lanes of all masks and octants that do not come in the order that they should.
int masks_out_of_order() {
  int wrong = 0;
  for (unsigned octant = 0; octant != 8; ++octant) {
    for (avx2::LaneMask mask = 0; mask != 256; ++mask) {
      alignas(32) std::array<std::uint32_t, 8> lanes;
      avx2::lanes_in_order(mask, octant).store(lanes.data());
      std::size_t size = 0;
      for (unsigned j = 0; j != 8; ++j) {
        const unsigned lane = j ^ octant;
        if ((mask >> lane & 1) != 0) wrong += lanes[size++] != lane;
      }
      for (; size != 8; ++size) wrong += lanes[size] != 0;
    }
  }
  return wrong;
}

/// Of eight numbers, whose lanes are picked in the order 7, 6, ... 0.
bool are_picked_by_lane() {
  alignas(32) const std::array<float, 8> numbers{0, 1, 2, 3, 4, 5, 6, 7};
  alignas(32) std::array<float, 8> picked;
  const avx2::Int8 lanes = avx2::lanes_in_order(0xFF, 7);
  avx2::picked(avx2::Float8::load(numbers.data()), lanes).store(picked.data());
  return picked == std::array<float, 8>{7, 6, 5, 4, 3, 2, 1, 0};
}

}  // namespace
TESSERA_END_AVX2

BOOST_AUTO_TEST_SUITE(lanes_avx2)

BOOST_AUTO_TEST_CASE(lanes_of_every_mask_come_in_the_order_of_every_octant) {
  if (!is_supported(Kernel::avx2)) {
    BOOST_TEST_MESSAGE("not tested: this machine has no AVX2");
    return;
  }
  BOOST_TEST(masks_out_of_order() == 0);
  BOOST_TEST(are_picked_by_lane());
}

BOOST_AUTO_TEST_SUITE_END()
#endif
