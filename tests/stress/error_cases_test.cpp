// SPDX-License-Identifier: BSD-3-Clause
// Bounds on the error of a picture.
#include "render/path_error.h"
#include "stress/stress_scene.h"

using namespace tessera::stress;

BOOST_AUTO_TEST_SUITE(error_cases)

// Each bounce multiplies errors by ten and more, so after some fifteen the picture is a matter of chance; what is
// certified still keeps its bound. The matrix's 16 kappa u (1 + shininess) M leaves out that a hit is rounded by u
// times its distance from the origin of the coordinates, which path_error.h counts.
BOOST_AUTO_TEST_CASE(case_37_four_mirrors_in_a_tetrahedron) {
  Verdict verdict(37, "bound holds on certified pixels; the others counted");
  SceneData data;
  const double reach = std::sqrt(0.5) * (1 + 1e-3 / 2);  // centres at distance 2 + 1e-3 from each other
  int channel = 0;
  for (const Vec3& corner : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
    Material ball{.color = {0.2, 0.2, 0.2}, .ambient = 0.1, .diffuse = 0.9, .specular = 0.5, .shininess = 20};
    (channel == 0 ? ball.color.r : channel == 1 ? ball.color.g : ball.color.b) = 0.9;
    ball.reflection = 0.9;
    add_sphere(data, reach * corner, 1, ball);
    ++channel;
  }
  add_point_light(data, {6, 5, 9});
  data.environment.background = {0.25, 0.5, 0.75};
  // Through the gap between three of them, at the fourth.
  data.camera = Camera{.eye = {-4, -4, -4}, .target = {0, 0, 0}, .fov = 7};
  data.image.max_bounces = 40;
  const Scene scene = prepared(data);
  constexpr std::uint32_t kSide = 128;
  const CameraRays rays(*scene.data().camera, kSide, kSide);
  std::size_t certified = 0;
  std::size_t above = 0;
  std::size_t flipped = 0;
  for (std::uint32_t i = 0; i != kSide * kSide; ++i) {
    const Ray ray = rays.through(i % kSide + 0.5, i / kSide + 0.5);
    const Region region = region_at(scene, ray.origin, ray.direction);
    PathError error(scene, region, Shade::phong);
    PathObserver* const observers[] = {&error};
    RayCounts counts;
    const Rgb seen = seen_from(scene, ray.origin, ray.direction, counts, observers);
    const QuadVec exact = QuadTracer(scene.view(), ray.origin, ray.direction).radiance();
    const double off = std::max({error_of(seen.r, exact.x), error_of(seen.g, exact.y), error_of(seen.b, exact.z)});
    certified += std::isfinite(error.bound());
    above += std::isfinite(error.bound()) && !(off <= error.bound());
    flipped += !std::isfinite(error.bound()) && off > 1e-3;
  }
  verdict.none_wrong("certified pixels above their bound", above, certified);
  const std::size_t others = kSide * kSide - certified;
  verdict.require(others > 0 && others < kSide * kSide / 10,
                  std::to_string(others) + " uncertified, of which " + std::to_string(flipped) + " off by 1e-3");
}

BOOST_AUTO_TEST_SUITE_END()
