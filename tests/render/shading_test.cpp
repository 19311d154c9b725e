// SPDX-License-Identifier: BSD-3-Clause
// Local light of many vertices at once against that of one after the other, bit for bit.
#include "render/shading.h"

#include <boost/test/unit_test.hpp>
#include <deque>

#include "render/kernels.h"
#include "render/random.h"
#include "render/same_bits.h"
#include "render/scene_fixture.h"
#include "render/vertex.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

template <class T, std::size_t N>
const T& one_of(Random& random, const T (&things)[N]) {
  return things[random.below(N)];
}

/// Weights and exponents at and beyond every border.
Material some_material(Random& random) {
  constexpr double kWeights[] = {0, -0.0, 0.3, 1, 1e-300, 1e30};
  constexpr double kExponents[] = {0, -0.0, 1, 2, 2.5, 50, 50, 50, 1e-3, 1023, 1e6, 0x1p31, 0x1p31 - 1, 1e30};
  constexpr double kReflections[] = {0, -0.0, 0.3, 0.9999999999999999, 1};
  Material material;
  material.color = {random.uniform(), random.flip() ? 0 : random.uniform(), random.uniform(0, 3)};
  material.diffuse = one_of(random, kWeights);
  material.specular = one_of(random, kWeights);
  material.shininess = one_of(random, kExponents);
  material.reflection = one_of(random, kReflections);
  return material;
}

/// Whole numbers, so that much is perpendicular, opposite or equal.
Vec3 small_vector(Random& random) {
  constexpr double kNumbers[] = {-1, -0.0, 0, 1};
  return {one_of(random, kNumbers), one_of(random, kNumbers), one_of(random, kNumbers)};
}

Vec3 some_direction(Random& random) {
  for (;;) {
    const Vec3 v = random.flip() ? random.direction() : small_vector(random);
    if (v != Vec3{}) return normalized(v);
  }
}

struct Batch {
  std::deque<Material> materials;
  Vertices vertices;
};

/// Vertices some of which are at lights, and some so near or so far that the way there has no square.
void refill(Batch& batch, Random& random, std::uint32_t size) {
  constexpr double kDistances[] = {1e-180, 1e-40, 1, 1, 1, 1e40, 1e180};
  batch.materials.clear();
  batch.vertices.clear(size);
  for (std::uint32_t i = 0; i != size; ++i) {
    const Material& material = batch.materials.emplace_back(some_material(random));
    const Vec3 normal = some_direction(random);
    // Mostly from the side that the normal faces, at times from right above.
    Vec3 incoming = random.below(4) == 0 ? -normal : some_direction(random);
    if (dot(incoming, normal) > 0) incoming = -incoming;
    batch.vertices.add({.ray = i,
                        .material = &material,
                        .point = one_of(random, kDistances) * small_vector(random),
                        .normal = normal,
                        .incoming = one_of(random, kDistances) * incoming,
                        .local = {}});
  }
}

int differences_in_viewers(const Vertices& a, const Vertices& b) {
  int differences = 0;
  for (std::size_t i = 0; i != a.size(); ++i) {
    const VertexLanes& at = a.lanes()[i / kLanes];
    const std::size_t lane = i % kLanes;
    if (!(at.material[lane]->specular > 0)) continue;
    differences += !same_bits(at.to_viewer[lane], b.lanes()[i / kLanes].to_viewer[lane]);
  }
  return differences;
}

/// What vertices get from a light; a dark one gets nothing, and there is no way.
struct Received {
  int lit = 0;
  int differences = 0;
};
Received compare_light(const Light& light, Shade shade, const Vertices& vertices) {
  std::vector<LightLanes> together(vertices.lanes().size());
  light_up(Kernel::avx2, light, shade, vertices, together);
  Received received;
  for (std::size_t i = 0; i != vertices.size(); ++i) {
    const VertexLanes& at = vertices.lanes()[i / kLanes];
    const std::size_t lane = i % kLanes;
    const LightLanes& got = together[i / kLanes];
    const Material& material = *at.material[lane];
    const Vec3 way = way_to(light, at.point[lane]);
    const bool shines = material.reflection < 1 && shows_light(material) && dot(at.normal[lane], way) > 0;
    received.differences += got.shines[lane] != (shines ? 1 : 0);
    if (!shines) continue;
    const Rgb share =
        reflected_light(material, light.color, shade, at.normal[lane], normalized(way), at.to_viewer[lane]);
    received.differences += !same_bits(got.way[lane], way);
    received.differences += !same_bits(got.share[lane], Vec3{share.r, share.g, share.b});
    ++received.lit;
  }
  return received;
}

Light some_light(Random& random) {
  constexpr double kDistances[] = {1e-180, 1e-40, 1, 1, 1, 1e40, 1e180};
  constexpr double kColors[] = {0, 0.35, 1, 1e30};
  const bool is_point = random.below(3) != 0;
  const Vec3 vector = one_of(random, kDistances) * (is_point ? small_vector(random) : some_direction(random));
  return {is_point ? LightKind::point : LightKind::directional,
          vector,
          {one_of(random, kColors), one_of(random, kColors), random.uniform()}};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(shading)

BOOST_AUTO_TEST_CASE(lanes_shade_vertices_of_every_kind_like_the_scalar_functions_to_the_bit) {
  if (!is_supported(Kernel::avx2)) {
    BOOST_TEST_MESSAGE("not tested: this machine has no AVX2");
    return;
  }
  Random random(71);
  Batch batch;
  Received all;
  for (int i = 0; i != 4000; ++i) {
    refill(batch, random, random.below(11));
    Vertices alone = batch.vertices;
    turn_to_viewers(Kernel::avx2, batch.vertices);
    turn_to_viewers(Kernel::scalar, alone);
    BOOST_REQUIRE(differences_in_viewers(alone, batch.vertices) == 0);
    for (const Shade shade : {Shade::phong, Shade::blinn}) {
      const Received received = compare_light(some_light(random), shade, batch.vertices);
      all.lit += received.lit;
      all.differences += received.differences;
    }
  }
  BOOST_TEST(all.differences == 0);
  BOOST_TEST(all.lit > 5000);
}

// The specification of a batch is what a path computes alone.
BOOST_AUTO_TEST_CASE(light_of_one_vertex_is_that_of_vertex_and_phong) {
  const Material material{.color = {0.5, 1, 2}, .diffuse = 0.5, .specular = 0.25, .shininess = 2};
  const Light light{LightKind::point, {0.6, 0, 0.8}, {1, 2, 4}};
  for (const auto& [kernel, name] : supported_kernels()) {
    Vertices vertices;
    vertices.clear(1);
    vertices.add(
        {.ray = 0, .material = &material, .point = {}, .normal = {0, 0, 1}, .incoming = {0, 0, -3}, .local = {}});
    turn_to_viewers(kernel, vertices);
    std::vector<LightLanes> shares(1);
    light_up(kernel, light, Shade::phong, vertices, shares);
    const Rgb expected = reflected_light(material, light.color, Shade::phong, {0, 0, 1}, {0.6, 0, 0.8}, {0, 0, 1});
    BOOST_TEST(shares[0].shines[0] == 1, name);
    BOOST_TEST((shares[0].way[0] == Vec3{0.6, 0, 0.8}), name);
    BOOST_TEST((shares[0].share[0] == Vec3{expected.r, expected.g, expected.b}), name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
