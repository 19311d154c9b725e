// SPDX-License-Identifier: BSD-3-Clause
#include <boost/test/unit_test.hpp>

#include "app/small_job.h"
#include "render/kernels.h"
#include "scheduler/run.h"

using namespace tessera;
using namespace tessera::app;

namespace {

std::string files_in_process(const RenderJob& job, const render::Scene& scene, std::uint32_t ranks,
                             std::uint64_t seed) {
  return test::files_of(job, scene, ranks, [&](const auto& plan, const auto& work, const auto& accept) {
    scheduler::run_in_process(ranks, seed, plan, work, accept);
  });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(OnePicture)

BOOST_AUTO_TEST_CASE(every_rank_count_tile_size_policy_and_arrival_order_gives_the_same_bytes) {
  RenderJob job = test::small_job();
  const render::Scene scene(job.scene, job.kernel);
  const std::string reference = test::reference_files(job, scene);
  for (const test::Sharing& sharing : test::all_sharings(job)) {
    sharing.apply_to(job);
    for (std::uint32_t ranks = 1; ranks <= 4; ++ranks) {
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        BOOST_TEST_CONTEXT(sharing.text() << ", " << ranks << " ranks, seed " << seed) {
          BOOST_TEST((files_in_process(job, scene, ranks, seed) == reference));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(every_master_role_and_prefetch_gives_the_same_bytes) {
  RenderJob job = test::small_job();
  const render::Scene scene(job.scene, job.kernel);
  const std::string reference = test::reference_files(job, scene);
  job.tile_width = 5;
  job.tile_height = 3;
  for (const auto role : {scheduler::MasterRole::dedicated, scheduler::MasterRole::rendering}) {
    for (const unsigned prefetch : {1u, 3u, 1000u}) {
      job.master = role;
      job.prefetch = prefetch;
      BOOST_TEST((files_in_process(job, scene, 3, prefetch) == reference), name_of(role) << ", prefetch " << prefetch);
    }
  }
}

// With signatures and errors, and as a picture alone, which is traced in another order.
BOOST_AUTO_TEST_CASE(every_kernel_gives_the_same_bytes) {
  RenderJob job = test::small_job();
  const render::Scene brute(job.scene, render::Kernel::brute);
  const std::string reference = test::reference_files(job, brute);
  job.layers = {};
  const std::string picture = test::reference_files(job, brute);
  for (const auto& [kernel, name] : render::test::supported_kernels()) {
    job.layers = {.signatures = true, .errors = true};
    job.kernel = kernel;
    const render::Scene scene(job.scene, job.kernel);
    BOOST_TEST((test::reference_files(job, scene) == reference), name);
    BOOST_TEST((files_in_process(job, scene, 3, 1) == reference), name);
    job.layers = {};
    BOOST_TEST((test::reference_files(job, scene) == picture), name);
    BOOST_TEST((files_in_process(job, scene, 3, 2) == picture), name);
  }
}

BOOST_AUTO_TEST_CASE(a_crop_holds_the_same_pixels_as_the_whole_picture) {
  RenderJob job = test::small_job();
  const render::Scene scene(job.scene, job.kernel);
  const auto image_of = [&] {
    const auto tiles = tiles_of(job, 1);
    const TileWork work(scene, job, tiles);
    Mosaic mosaic(job, tiles);
    for (std::uint32_t i = 0; i != tiles.size(); ++i) {
      mosaic.accept(scheduler::TaskId{i}, work(scheduler::TaskId{i}, [] {}));
    }
    return mosaic.image();
  };
  const render::Image whole = image_of();
  const render::Rect crop{5, 3, 21, 17};
  job.area = crop;
  const render::Image part = image_of();
  BOOST_TEST_REQUIRE(part.bytes.size() == crop.pixels() * 3);
  for (std::size_t y = 0; y != crop.height; ++y) {
    const auto row = part.bytes.begin() + static_cast<std::ptrdiff_t>(3 * y * crop.width);
    const auto same = whole.bytes.begin() + static_cast<std::ptrdiff_t>(3 * ((y + crop.y) * whole.width + crop.x));
    BOOST_TEST(std::equal(row, row + 3 * crop.width, same));
  }
}

BOOST_AUTO_TEST_SUITE_END()
