// SPDX-License-Identifier: BSD-3-Clause
// Whole pictures: one for every way to share the work, and the numbers that their pixels are rounded to.
#include <array>
#include <cstring>

#include "app/small_job.h"
#include "render/encode.h"
#include "render/kernels.h"
#include "render/reference/quad_power.h"
#include "scheduler/run.h"
#include "stress/stress_scene.h"

using namespace tessera::stress;

namespace {

/// 255 times the encoded value, before it is rounded. 5/12 as a double is off by 3e-17, and 255 x ln x times that is
/// nothing beside 1e-9.
Quad exact_number(Quad linear, Transfer transfer) {
  const Quad clamped = linear < 0 ? 0 : linear > 1 ? 1 : linear;
  if (transfer == Transfer::none) return 255 * clamped;
  const Quad tenth = Quad(1) / 10000000;
  if (clamped <= 31308 * tenth) return 255 * clamped * 1292 / 100;
  return 255 * (1055 * quad_power(clamped, 1 / 2.4) - 55) / 1000;
}

/// Numbers of 8 bits against quad precision, rounded half up.
struct RoundingCheck {
  void look(std::uint8_t number, Quad linear, Transfer transfer) {
    const Quad exact = exact_number(linear, transfer);
    const Quad place = exact + 0.5 - number;  // in [0, 1) where the number is right
    const double to_step = static_cast<double>(std::min(magnitude(place), magnitude(place - 1)));
    const bool is_right = place >= 0 && place < 1;
    ++tried;
    near_step += to_step <= 1e-9;
    wrong += !is_right && to_step > 1e-9;
    wrong_near_step += !is_right && to_step <= 1e-9;
  }
  void report(Verdict& verdict, const std::string& what) const {
    verdict.none_wrong(what, wrong, tried);
    verdict.note(std::to_string(near_step) + " within 1e-9 of a step, " + std::to_string(wrong_near_step) +
                 " of them rounded the other way");
  }

  std::size_t tried = 0;
  std::size_t near_step = 0;
  std::size_t wrong = 0;
  std::size_t wrong_near_step = 0;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(picture_cases)

// The switches for skipped work come with the techniques that they choose from.
// That g++ and clang++ give the same bytes is for scripts/compare_builds.sh to show, with two builds.
BOOST_AUTO_TEST_CASE(case_41_one_picture_however_it_is_made) {
  namespace app = tessera::app;
  namespace scheduler = tessera::scheduler;
  Verdict verdict(41, "same bytes: scalar, avx2 and brute force, tiles of 1 to 1024 px, 1 to 64 ranks");
  app::RenderJob job = app::test::small_job();
  const auto kernels = supported_kernels();
  if (!is_supported(Kernel::avx2)) verdict.note("avx2 is not supported here and was left out");
  std::vector<Scene> scenes;
  for (const NamedKernel& named : kernels) scenes.emplace_back(job.scene, named.kernel);
  std::size_t different = 0;
  std::size_t tried = 0;
  std::uint64_t seed = 41;
  // A picture alone is traced in another order than one whose paths are watched.
  for (const app::Layers layers : {app::Layers{}, app::Layers{.signatures = true, .errors = true}}) {
    job.layers = layers;
    const std::string reference = app::test::reference_files(job, scenes.front());
    for (std::size_t i = 1; i != scenes.size(); ++i, ++tried) {
      different += app::test::reference_files(job, scenes[i]) != reference;
    }
    for (const std::uint32_t side : {1u, 2u, 4u, 8u, 16u, 32u, 64u, 128u, 256u, 512u, 1024u}) {
      job.tile_width = side;
      job.tile_height = side;
      for (const std::uint32_t ranks : {1u, 2u, 3u, 7u, 16u, 33u, 64u}) {
        const Scene& scene = scenes[++seed % scenes.size()];
        const std::string png =
            app::test::files_of(job, scene, ranks, [&](const auto& plan, const auto& work, const auto& accept) {
              scheduler::run_in_process(ranks, seed, plan, work, accept);
            });
        different += png != reference;
        ++tried;
      }
    }
  }
  verdict.none_wrong("pictures differ", different, tried);
}

BOOST_AUTO_TEST_CASE(case_46_numbers_of_eight_bits) {
  Verdict verdict(46, "round(clamp(Q)) except within 1e-9 of a step");
  RoundingCheck pixels;
  RoundingCheck steps;
  Random random(46);
  for (const Transfer transfer : {Transfer::none, Transfer::srgb}) {
    // A picture
    SceneData data = small_scene();
    data.image.transfer = transfer;
    data.image.width = 96;
    data.image.height = 64;
    const Scene scene = prepared(data);
    const Image image = render_picture(scene, PixelFormat::rgb8);
    const CameraRays rays(*scene.data().camera, image.width, image.height);
    for (std::size_t i = 0; i != std::size_t{image.width} * image.height; ++i) {
      const Ray ray =
          rays.through(static_cast<double>(i % image.width) + 0.5, static_cast<double>(i / image.width) + 0.5);
      const QuadVec exact = QuadTracer(scene.view(), ray.origin, ray.direction).radiance();
      pixels.look(std::to_integer<std::uint8_t>(image.bytes[3 * i]), exact.x, transfer);
      pixels.look(std::to_integer<std::uint8_t>(image.bytes[3 * i + 1]), exact.y, transfer);
      pixels.look(std::to_integer<std::uint8_t>(image.bytes[3 * i + 2]), exact.z, transfer);
    }
    // Values about every step, and beyond both ends
    for (int i = 0; i != 30000; ++i) {
      const double step = (random.below(257) - 0.5) / 255;
      const double at = transfer == Transfer::none || step < 0 ? step : linear_from_srgb(step);
      const double value = at + (random.flip() ? 1 : -1) * random.over_decades(1e-17, 1e-3);
      std::array<std::byte, 3> pixel;
      encode_pixel({value, 0, 0}, PixelFormat::rgb8, transfer, pixel.data());
      steps.look(std::to_integer<std::uint8_t>(pixel[0]), value, transfer);
    }
  }
  pixels.report(verdict, "channels of pictures");
  steps.report(verdict, "values about steps");
}

BOOST_AUTO_TEST_SUITE_END()
