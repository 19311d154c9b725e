// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_writer.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "io/small_scene.h"
#include "io/tachyon_scene.h"
#include "io/temp_folder.h"
#include "render/scene_kinds.h"

namespace tessera::io {

using namespace render;
using test::material_of;

namespace {

using Notes = std::vector<std::string>;

struct Files {
  test::TempFolder folder;

  ReadScene read_back(const SceneData& scene) { return read_tachyon(folder.write("a.dat", write_tachyon(scene).text)); }
};

/// What a .dat file can hold of a scene.
SceneData sayable(SceneData scene) {
  scene.camera->handedness = Handedness::left;
  scene.environment.ambient = {1, 1, 1};
  scene.image.transfer = Transfer::none;
  for (Plane& plane : scene.planes) plane.checker.reset();
  for (Material& material : scene.materials) {
    if (material.reflection == 1) material.ambient = material.diffuse = material.specular = 0;
  }
  return scene;
}

bool are_near(double a, double b) {
  return std::abs(a - b) <= 4e-15 * std::abs(a);
}

/// Weights go through a product and a quotient.
bool are_near(const Material& a, const Material& b) {
  return a.color == b.color && a.shininess == b.shininess && a.reflection == b.reflection &&
         are_near(a.ambient, b.ambient) && are_near(a.diffuse, b.diffuse) && are_near(a.specular, b.specular);
}

void check_same(const SceneData& a, const SceneData& b) {
  BOOST_TEST_REQUIRE(a.spheres.size() == b.spheres.size());
  for (std::size_t i = 0; i < a.spheres.size(); ++i) {
    BOOST_TEST(coincide(a.spheres[i], b.spheres[i]), "sphere " << i);
    BOOST_TEST(are_near(material_of(a, a.spheres[i].material), material_of(b, b.spheres[i].material)), "sphere " << i);
  }
  BOOST_TEST_REQUIRE(a.planes.size() == b.planes.size());
  for (std::size_t i = 0; i < a.planes.size(); ++i) {
    BOOST_TEST(coincide(a.planes[i], b.planes[i]), "plane " << i);
    BOOST_TEST(are_near(material_of(a, a.planes[i].material), material_of(b, b.planes[i].material)), "plane " << i);
    BOOST_TEST((a.planes[i].checker.has_value() == b.planes[i].checker.has_value()), "plane " << i);
  }
  BOOST_TEST_REQUIRE(a.lights.size() == b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    BOOST_TEST((a.lights[i].kind == b.lights[i].kind), "light " << i);
    BOOST_TEST((a.lights[i].vector == b.lights[i].vector), "light " << i);
    BOOST_TEST((a.lights[i].color == b.lights[i].color), "light " << i);
  }
  BOOST_TEST((a.camera->eye == b.camera->eye));
  const double reach = length(a.camera->eye) + length(a.camera->target);
  BOOST_TEST(length(a.camera->target - b.camera->target) <= 4e-15 * reach);
  BOOST_TEST((a.camera->up == b.camera->up));
  BOOST_TEST((a.camera->projection == b.camera->projection));
  const bool is_flat = a.camera->projection == Projection::orthographic;
  BOOST_TEST((is_flat ? are_near(a.camera->height, b.camera->height) : are_near(a.camera->fov, b.camera->fov)));
  BOOST_TEST((a.camera->handedness == b.camera->handedness));
  BOOST_TEST((a.environment.background == b.environment.background));
  BOOST_TEST(a.image.width == b.image.width);
  BOOST_TEST(a.image.height == b.image.height);
  BOOST_TEST(a.image.max_bounces == b.image.max_bounces);
  BOOST_TEST((a.image.transfer == b.image.transfer));
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(TachyonWriter, Files)

// By hand: local weights are halved where the mirror takes half, ambient ones again by the ambient light; zoom is
// 1 / height; RAYDEPTH counts the first hit.
BOOST_AUTO_TEST_CASE(a_scene_is_written_as_by_hand) {
  BOOST_TEST(write_tachyon(test::small_scene()).text ==
             R"(# tachyon FILE -fullshade -shade_phong -numthreads 1 -format PPM -o out.ppm
BEGIN_SCENE
RESOLUTION 200 100
CAMERA PROJECTION ORTHOGRAPHIC
  ZOOM 0.5 ASPECTRATIO 1.0 ANTIALIASING 0 RAYDEPTH 4
  CENTER 0.0 -4.0 0.0 VIEWDIR 0.0 4.0 0.0 UPDIR 0.0 0.0 1.0
END_CAMERA
BACKGROUND 0.0 0.0 0.25
LIGHT CENTER 4.0 3.0 2.0 RAD 0.0 COLOR 1.0 0.5 0.0
DIRECTIONAL_LIGHT DIRECTION 0.0 0.0 -2.0 COLOR 0.25 0.25 0.25
TEXDEF m0 AMBIENT 0.05 DIFFUSE 0.4 SPECULAR 0.5 OPACITY 1.0 PHONG PLASTIC 0.2 PHONG_SIZE 20.0 COLOR 0.5 0.25 0.125 TEXFUNC 0
TEXDEF m1 AMBIENT 0.05 DIFFUSE 0.9 SPECULAR 0.0 OPACITY 1.0 PHONG PLASTIC 0.0 PHONG_SIZE 32.0 COLOR 1.0 0.0 0.0 TEXFUNC 0
PLANE CENTER 0.0 0.0 -2.0 NORMAL 0.0 0.0 2.0 m1
PLANE CENTER 0.0 0.0 7.0 NORMAL 0.0 4.0 0.0 m0
SPHERE CENTER 1.0 2.0 3.0 RAD 0.5 m0
SPHERE CENTER -1.25 1e-09 1e+22 RAD 2.0 m1
END_SCENE
)");
}

BOOST_AUTO_TEST_CASE(what_a_file_can_say_reads_back_as_it_was) {
  const SceneData scene = sayable(test::small_scene());
  const ReadScene read = read_back(scene);
  check_same(scene, read.scene);
  BOOST_TEST(read.notes == Notes{});
}

BOOST_AUTO_TEST_CASE(random_scenes_read_back_as_they_were) {
  for (const auto& kind : render::test::scene_kinds()) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      BOOST_TEST_CONTEXT(kind.name << ", seed " << seed) {
        SceneData scene = render::test::random_scene(kind, seed);
        scene.camera = Camera{kind.center + Vec3{0, -3 * kind.size, 0}, kind.center, {0, 0, 1}};
        scene.camera->fov = 20 + 17.5 * static_cast<double>(seed);
        scene.camera->height = kind.size;
        if (seed % 2 == 0) scene.camera->projection = Projection::orthographic;
        std::erase_if(scene.spheres, [](const Sphere& sphere) { return sphere.radius == 0; });
        scene = sayable(std::move(scene));
        check_same(scene, read_back(scene).scene);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(what_a_file_cannot_say_is_noted) {
  SceneData scene = test::small_scene();
  const std::string bright =
      "drawn brighter: what is seen beyond the last bounce (Tachyon shows all of the background there)";
  BOOST_TEST(write_tachyon(scene).notes == (Notes{"Tachyon's picture will be the mirror image (it is left-handed)",
                                                  "drawn in the material of the even cells: 1 checker board", bright}));
  scene = sayable(std::move(scene));
  scene.environment.ambient = {0.25, 0.5, 0.75};
  scene.image.shade = Shade::blinn;
  const WrittenScene written = write_tachyon(scene);
  BOOST_TEST(written.notes ==
             (Notes{"drawn grey: the ambient light", "not said: shade \"blinn\" (run with -shade_blinn)", bright}));
  BOOST_TEST(written.text.starts_with("# tachyon FILE -fullshade -shade_blinn "));
  BOOST_TEST(written.text.find("m1 AMBIENT 0.05 ") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
