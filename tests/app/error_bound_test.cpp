// SPDX-License-Identifier: BSD-3-Clause
// Error bounds against quad precision, on the scenes of the collection.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <filesystem>

#include "io/scene_reader.h"
#include "render/camera.h"
#include "render/path_error.h"
#include "render/quad_oracle.h"
#include "render/reference/quad_tracer.h"
#include "render/scale.h"
#include "render/tracer.h"

using namespace tessera;
using namespace tessera::render;
using namespace tessera::render::test;

BOOST_AUTO_TEST_SUITE(ErrorBound)

// As many pixels of each as brute force in quad precision affords.
BOOST_AUTO_TEST_CASE(holds_on_every_scene_of_the_collection) {
  std::size_t scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TESSERA_SCENES)) {
    if (entry.path().extension() != ".toml") continue;
    ++scenes;
    const Scene scene(unit_scaled(io::read_scene(entry.path()).scene), Kernel::automatic);
    const std::size_t cost = std::max<std::size_t>(scene.sphere_count(), 50);
    const auto side =
        static_cast<std::uint32_t>(std::clamp(std::sqrt(300'000.0 / static_cast<double>(cost)), 3.0, 30.0));
    const CameraRays rays(scene.data().camera.value(), side, side);
    std::size_t certified = 0;
    double closest = 0;
    for (std::uint32_t i = 0; i != side * side; ++i) {
      const Ray ray = rays.through(i % side + 0.5, i / side + 0.5);
      const Region region(scene, scene.placement_of(ray.origin), ray.origin, ray.direction);
      PathError path_error(scene, region, scene.data().image.shade);
      PathObserver* const observers[] = {&path_error};
      RayCounts counts;
      const Rgb seen = radiance_along(scene, ray, region, {scene.data().image.max_bounces, scene.data().image.shade},
                                      counts, observers);
      if (std::isinf(path_error.bound())) continue;
      ++certified;
      const auto exact = QuadTracer(scene.view(), ray.origin, ray.direction).radiance();
      const double error = std::max({error_of(seen.r, exact.x), error_of(seen.g, exact.y), error_of(seen.b, exact.z)});
      closest = std::max(closest, error / path_error.bound());
    }
    BOOST_TEST_MESSAGE(entry.path().filename() << ": " << certified << " of " << side * side
                                               << " pixels certified, error at most " << closest << " of its bound");
    BOOST_TEST(closest <= 1, entry.path());
    BOOST_TEST(certified >= side * side * 9 / 10, entry.path());
  }
  BOOST_TEST(scenes >= 7u);
}

BOOST_AUTO_TEST_SUITE_END()
