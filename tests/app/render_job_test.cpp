// SPDX-License-Identifier: BSD-3-Clause
#include "app/render_job.h"

#include <boost/test/unit_test.hpp>
#include <utility>
#include <vector>

#include "app/small_job.h"
#include "io/error.h"

using namespace tessera;
using namespace tessera::app;

BOOST_AUTO_TEST_SUITE(Job)

BOOST_AUTO_TEST_CASE(a_job_survives_the_way_to_another_rank) {
  RenderJob job = test::small_job();
  job.area = {3, 4, 20, 10};
  job.format = render::PixelFormat::rgb16;
  job.kernel = render::Kernel::brute;
  job.tracer = render::Tracer::reference;
  job.tile_width = 9;
  job.tile_height = 2;
  job.policy = scheduler::Policy::guided;
  job.master = scheduler::MasterRole::dedicated;
  job.layers = {.signatures = true, .errors = false};
  job.prefetch = 5;
  job.ask_back = false;
  job.lease_s = 2.5;
  job.compares_clocks = true;
  const RenderJob copy = decode_job(encode_job(job));
  BOOST_TEST((copy.area == job.area));
  BOOST_TEST((copy.format == job.format));
  BOOST_TEST((copy.kernel == job.kernel));
  BOOST_TEST((copy.tracer == job.tracer));
  BOOST_TEST((copy.layers.signatures && !copy.layers.errors));
  BOOST_TEST(copy.tile_width == 9u);
  BOOST_TEST(copy.tile_height == 2u);
  BOOST_TEST((copy.policy == job.policy));
  BOOST_TEST((copy.master == job.master));
  BOOST_TEST(copy.prefetch.value() == 5u);
  BOOST_TEST(!copy.ask_back);
  BOOST_TEST(copy.lease_s == 2.5);
  BOOST_TEST(copy.compares_clocks);
  BOOST_TEST(copy.scene.spheres.size() == job.scene.spheres.size());
  BOOST_TEST((encode_job(copy) == encode_job(job)));
}

BOOST_AUTO_TEST_CASE(tiles_of_no_size_travel_with_the_job) {
  RenderJob job = test::small_job();
  job.cut = test::uneven_tiles(job.area);
  const RenderJob copy = decode_job(encode_job(job));
  BOOST_TEST((tiles_of(copy, 3) == tiles_of(job, 3)));
  BOOST_TEST(tiles_of(job, 3).size() == job.cut.size());
  BOOST_TEST((tiles_of(job, 3)[1] == job.cut[1].rect));
  const scheduler::Plan plan = plan_of(copy, tiles_of(copy, 3));
  BOOST_TEST(plan.costs.size() == job.cut.size());
  BOOST_TEST(plan.costs[0] == static_cast<float>(job.cut[0].cost));
  BOOST_TEST((encode_job(copy) == encode_job(job)));
  job.policy = scheduler::Policy::static_bands;
  BOOST_TEST(tiles_of(job, 3).size() == 3u);
  BOOST_TEST(plan_of(job, tiles_of(job, 3)).costs.empty());
}

BOOST_AUTO_TEST_CASE(a_job_cut_off_anywhere_is_refused) {
  RenderJob job = test::small_job();
  job.cut = test::uneven_tiles(job.area);
  const scheduler::Bytes bytes = encode_job(job);
  for (std::size_t size = 0; size < bytes.size(); size += size < 100 ? 1 : 97) {
    BOOST_CHECK_THROW(decode_job(std::span(bytes).first(size)), io::Error);
  }
}

BOOST_AUTO_TEST_CASE(static_bands_ignore_the_tile_size_and_cyclic_rows_are_one_pixel_high) {
  RenderJob job = test::small_job();
  job.policy = scheduler::Policy::static_bands;
  BOOST_TEST(tiles_of(job, 4).size() == 4u);
  BOOST_TEST(tiles_of(job, 100).size() == job.area.height);
  job.policy = scheduler::Policy::cyclic_rows;
  const auto rows = tiles_of(job, 4);
  BOOST_TEST(rows.size() == job.area.height);
  BOOST_TEST((rows[7] == render::Rect{0, 7, job.area.width, 1}));
}

BOOST_AUTO_TEST_CASE(the_mosaic_refuses_a_delivery_of_another_size) {
  const RenderJob job = test::small_job();
  const auto tiles = tiles_of(job, 1);
  Mosaic mosaic(job, tiles);
  const scheduler::Bytes short_delivery(10);
  BOOST_CHECK_THROW(mosaic.accept(scheduler::TaskId{0}, short_delivery), std::runtime_error);
}

BOOST_AUTO_TEST_CASE(complete_rows_end_where_the_first_pixel_is_missing) {
  RenderJob job = test::small_job();
  job.area = {3, 5, 20, 12};  // 2 x 2 tiles, the last ones cut
  job.tile_height = 8;
  const render::Scene scene(job.scene, job.kernel);
  const auto tiles = tiles_of(job, 1);
  const TileWork work(scene, job, tiles);
  const auto rows_after = [&](const std::vector<std::uint32_t>& order) {
    Mosaic mosaic(job, tiles);
    std::vector<std::uint32_t> rows;
    for (const std::uint32_t i : order) {
      mosaic.accept(scheduler::TaskId{i}, work(scheduler::TaskId{i}, [] {}));
      rows.push_back(mosaic.complete_rows());
    }
    return rows;
  };
  BOOST_TEST((rows_after({0, 1, 2, 3}) == std::vector<std::uint32_t>{0, 8, 8, 12}));
  BOOST_TEST((rows_after({3, 0, 2, 1}) == std::vector<std::uint32_t>{0, 0, 0, 12}));
}

BOOST_AUTO_TEST_CASE(layers_find_their_place_in_the_mosaic) {
  RenderJob job = test::small_job();
  const render::Scene scene(job.scene, job.kernel);
  const auto assembled = [&] {
    const auto tiles = tiles_of(job, 1);
    const TileWork work(scene, job, tiles);
    Mosaic mosaic(job, tiles);
    for (std::uint32_t i = 0; i != tiles.size(); ++i) {
      mosaic.accept(scheduler::TaskId{i}, work(scheduler::TaskId{i}, [] {}));
    }
    return std::pair(mosaic.signatures().pixels, std::vector(mosaic.errors().begin(), mosaic.errors().end()));
  };
  const auto [tiled_signatures, tiled_errors] = assembled();
  job.tile_width = job.tile_height = 1000;
  const auto [signatures, errors] = assembled();
  BOOST_TEST(signatures.size() == job.area.pixels());
  BOOST_TEST(errors.size() == job.area.pixels());
  BOOST_TEST((tiled_signatures == signatures));
  BOOST_TEST((tiled_errors == errors));
  BOOST_TEST((signatures.front() != render::Signature{} && signatures.front() != signatures.back()));
  BOOST_TEST((errors.front() > 0 && errors.front() != errors.back()));

  job.layers = {.signatures = false, .errors = true};
  BOOST_TEST(assembled().first.empty());
  BOOST_TEST((assembled().second == errors));
  job.layers = {};
  BOOST_TEST(assembled().second.empty());
}

BOOST_AUTO_TEST_CASE(rays_are_counted_per_tile_and_add_up_to_the_whole) {
  const RenderJob job = test::small_job();
  const render::Scene scene(job.scene, job.kernel);
  const auto counted = [&](std::uint32_t tile_size) {
    RenderJob cut = job;
    cut.tile_width = cut.tile_height = tile_size;
    const auto tiles = tiles_of(cut, 1);
    const TileWork work(scene, cut, tiles);
    Mosaic mosaic(cut, tiles);
    for (std::uint32_t i = 0; i != tiles.size(); ++i) {
      mosaic.accept(scheduler::TaskId{i}, work(scheduler::TaskId{i}, [] {}));
    }
    render::RayCounts sum;
    for (const render::RayCounts& counts : mosaic.rays()) sum += counts;
    return sum;
  };
  const render::RayCounts whole = counted(1000);
  const render::RayCounts parts = counted(4);
  BOOST_TEST(whole.primary == job.area.pixels() * job.scene.image.samples);
  BOOST_TEST(whole.primary == parts.primary);
  BOOST_TEST(whole.shadow == parts.shadow);
  BOOST_TEST(whole.mirror == parts.mirror);
  BOOST_TEST(whole.shadow > 0u);
  BOOST_TEST(whole.mirror > 0u);
}

BOOST_AUTO_TEST_SUITE_END()
