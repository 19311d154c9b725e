// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_codec.h"

#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "io/temp_folder.h"

namespace tessera::io {

using namespace render;

namespace {

/// A scene in which no member has its default value.
SceneData full_scene() {
  SceneData scene;
  scene.image = {640, 480, 9, 3, Transfer::none, Shade::blinn};
  scene.environment = {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}};
  scene.camera = Camera{{1, 2, 3}, {4, 5, 6}, {0, 1, 0}, Projection::orthographic, 30, 2.5, Handedness::left};
  scene.materials = {{{0.1, 0.2, 0.3}, 0.4, 0.5, 0.6, 7, 0.8}, {{1, 0, 0}, 0, 1, 0, 1, 0}};
  scene.lights = {{LightKind::directional, {1, -2, 3}, {4, 5, 6}}, {LightKind::point, {7, 8, 9}, {1, 1, 1}}};
  scene.planes = {{{1, 2, 3}, {0, 1, 1}, MaterialIndex{1}, Checker{MaterialIndex{0}, 0.25}},
                  {{0, 0, -1}, {0, 0, 1}, MaterialIndex{0}, std::nullopt}};
  scene.spheres = {{{0.1, -0.0, 1e-310}, 0.5, MaterialIndex{1}},
                   {{std::numeric_limits<double>::max(), 1, 2}, 0, MaterialIndex{0}}};
  return scene;
}

bool same_bits(const Vec3& a, const Vec3& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool decodes(std::span<const std::byte> bytes) {
  const auto error = test::error_of([&] { decode_scene(bytes); });
  if (error) BOOST_TEST((error->kind() == ErrorKind::bad_scene));
  return !error;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(SceneCodec)

BOOST_AUTO_TEST_CASE(every_member_comes_back_to_the_bit) {
  const SceneData scene = full_scene();
  const SceneData back = decode_scene(encode_scene(scene));

  BOOST_TEST(back.image.width == 640u);
  BOOST_TEST(back.image.height == 480u);
  BOOST_TEST(back.image.samples == 9u);
  BOOST_TEST(back.image.max_bounces == 3u);
  BOOST_TEST((back.image.transfer == Transfer::none));
  BOOST_TEST((back.image.shade == Shade::blinn));
  BOOST_TEST((back.environment.ambient == scene.environment.ambient));
  BOOST_TEST((back.environment.background == scene.environment.background));

  BOOST_TEST_REQUIRE(back.camera.has_value());
  BOOST_TEST((back.camera->eye == scene.camera->eye));
  BOOST_TEST((back.camera->target == scene.camera->target));
  BOOST_TEST((back.camera->up == scene.camera->up));
  BOOST_TEST((back.camera->projection == Projection::orthographic));
  BOOST_TEST(back.camera->fov == 30);
  BOOST_TEST(back.camera->height == 2.5);
  BOOST_TEST((back.camera->handedness == Handedness::left));

  BOOST_TEST((back.materials == scene.materials));
  BOOST_TEST_REQUIRE(back.lights.size() == 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    BOOST_TEST((back.lights[i].kind == scene.lights[i].kind));
    BOOST_TEST((back.lights[i].vector == scene.lights[i].vector));
    BOOST_TEST((back.lights[i].color == scene.lights[i].color));
  }
  BOOST_TEST_REQUIRE(back.planes.size() == 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    BOOST_TEST((back.planes[i].point == scene.planes[i].point));
    BOOST_TEST((back.planes[i].normal == scene.planes[i].normal));
    BOOST_TEST((back.planes[i].material == scene.planes[i].material));
  }
  BOOST_TEST_REQUIRE(back.planes[0].checker.has_value());
  BOOST_TEST((back.planes[0].checker->material == MaterialIndex{0}));
  BOOST_TEST(back.planes[0].checker->size == 0.25);
  BOOST_TEST(!back.planes[1].checker);
  BOOST_TEST_REQUIRE(back.spheres.size() == 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    BOOST_TEST(same_bits(back.spheres[i].center, scene.spheres[i].center));
    BOOST_TEST(back.spheres[i].radius == scene.spheres[i].radius);
    BOOST_TEST((back.spheres[i].material == scene.spheres[i].material));
  }
  BOOST_TEST((encode_scene(back) == encode_scene(scene)));
}

BOOST_AUTO_TEST_CASE(an_empty_scene_comes_back_empty) {
  const SceneData back = decode_scene(encode_scene({}));
  BOOST_TEST(back.spheres.empty());
  BOOST_TEST(back.materials.empty());
  BOOST_TEST(!back.camera);
  BOOST_TEST(back.image.width == 1280u);
}

BOOST_AUTO_TEST_CASE(equal_scenes_are_equal_bytes_whatever_lies_in_the_padding) {
  SceneData a;
  a.materials.resize(1);
  a.spheres.resize(3);
  SceneData b = a;
  std::memset(static_cast<void*>(b.spheres.data()), 0, 3 * sizeof(Sphere));
  std::memset(reinterpret_cast<char*>(b.spheres.data()) + 36, 0xff, 4);
  BOOST_TEST((encode_scene(a) == encode_scene(b)));
}

// Spheres are hashed in pieces of 4,096.
BOOST_AUTO_TEST_CASE(any_byte_of_a_scene_changes_its_hash) {
  SceneData scene = full_scene();
  scene.spheres.resize(5'000, scene.spheres[0]);
  const std::uint64_t hash = hash_of(scene);
  BOOST_TEST(hash_of(decode_scene(encode_scene(scene))) == hash);
  const auto other_hash = [&](auto change) {
    SceneData other = scene;
    change(other);
    return hash_of(other);
  };
  BOOST_TEST(other_hash([](SceneData& s) { s.image.samples = 4; }) != hash);
  BOOST_TEST(other_hash([](SceneData& s) { s.camera->fov += 1e-9; }) != hash);
  BOOST_TEST(other_hash([](SceneData& s) { s.lights.pop_back(); }) != hash);
  BOOST_TEST(other_hash([](SceneData& s) { s.spheres.pop_back(); }) != hash);
  BOOST_TEST(other_hash([](SceneData& s) { s.spheres.resize(4096); }) != hash);
  for (const std::size_t i : {0u, 4095u, 4096u, 4999u}) {
    BOOST_TEST(other_hash([&](SceneData& s) { s.spheres[i].center.x = 0.25; }) != hash);
    BOOST_TEST(other_hash([&](SceneData& s) { s.spheres[i].material = MaterialIndex{0}; }) != hash);
  }
}

BOOST_AUTO_TEST_CASE(every_truncation_is_refused) {
  const auto bytes = encode_scene(full_scene());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    BOOST_TEST(!decodes(std::span(bytes).first(size)), "the first " << size << " of " << bytes.size() << " bytes");
  }
  BOOST_TEST(decodes(bytes));
}

BOOST_AUTO_TEST_CASE(bytes_after_the_end_are_refused) {
  auto bytes = encode_scene(full_scene());
  bytes.push_back(std::byte{0});
  BOOST_TEST(!decodes(bytes));
}

BOOST_AUTO_TEST_CASE(junk_is_refused) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 1000; ++round) {
    std::vector<std::byte> junk(random() % 400);
    for (std::byte& byte : junk) byte = static_cast<std::byte>(random() & 0xff);
    BOOST_TEST(!decodes(junk));
  }
}

BOOST_AUTO_TEST_CASE(a_flipped_bit_never_does_harm) {
  const auto bytes = encode_scene(full_scene());
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
    auto flipped = bytes;
    flipped[i / 8] ^= std::byte{1} << (i % 8);
    const auto error = test::error_of([&] {
      // What gets through must at least refer to materials that are there
      const SceneData scene = decode_scene(flipped);
      for (const Sphere& sphere : scene.spheres) {
        BOOST_TEST_REQUIRE(static_cast<std::size_t>(sphere.material) < scene.materials.size());
      }
      for (const Plane& plane : scene.planes) {
        BOOST_TEST_REQUIRE(static_cast<std::size_t>(plane.material) < scene.materials.size());
        if (!plane.checker) continue;
        BOOST_TEST_REQUIRE(static_cast<std::size_t>(plane.checker->material) < scene.materials.size());
      }
      BOOST_TEST_REQUIRE(static_cast<int>(scene.image.shade) <= 1);
      BOOST_TEST_REQUIRE(static_cast<int>(scene.image.transfer) <= 1);
    });
    if (i < 8 * 12) BOOST_TEST(error.has_value(), "bit " << i << " of the magic number and the version");
  }
}

BOOST_AUTO_TEST_CASE(a_huge_count_is_refused_before_memory_is_taken_for_it) {
  auto bytes = encode_scene({});
  const std::uint64_t huge = std::uint64_t{1} << 60;
  std::memcpy(bytes.data() + bytes.size() - sizeof huge, &huge, sizeof huge);  // the count of spheres comes last
  BOOST_TEST(!decodes(bytes));
}

BOOST_AUTO_TEST_CASE(a_material_that_is_not_there_is_refused) {
  SceneData scene = full_scene();
  scene.spheres[1].material = MaterialIndex{2};
  BOOST_TEST(!decodes(encode_scene(scene)));
  scene = full_scene();
  scene.planes[1].material = MaterialIndex{2};
  BOOST_TEST(!decodes(encode_scene(scene)));
  scene = full_scene();
  scene.planes[0].checker->material = MaterialIndex{2};
  BOOST_TEST(!decodes(encode_scene(scene)));
}

BOOST_AUTO_TEST_CASE(spheres_and_materials_may_travel_apart_but_only_together) {
  SceneData scene = full_scene();
  scene.materials.clear();
  BOOST_TEST(!decodes(encode_scene(scene)));
  scene.spheres.clear();
  BOOST_TEST(decodes(encode_scene(scene)));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
