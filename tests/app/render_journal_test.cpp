// SPDX-License-Identifier: BSD-3-Clause
#include "app/render_journal.h"

#include <boost/test/unit_test.hpp>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "app/open_tiles.h"
#include "app/small_job.h"
#include "io/temp_folder.h"

namespace tessera::app {
namespace {

using io::ExistingJournal;
using io::test::slurp;
using io::test::TempFolder;

/// A part of the small picture that is quick to render again and again.
RenderJob tiny_job() {
  RenderJob job = test::small_job();
  job.area = {9, 8, 8, 6};
  return job;
}

std::string files_of(const RenderJob& job, const Mosaic& mosaic) {
  return io::encode_image(io::ImageFormat::png, mosaic.image(), job.scene.image.transfer, {}) +
         io::encode_signatures(mosaic.signatures()) + io::encode_pfm(job.area.width, job.area.height, mosaic.errors());
}

/// What a run of the program does with a journal, and what came of it.
struct Run {
  std::size_t open = 0;  ///< tiles
  std::string files;
  std::uint64_t rays = 0;
};

/// Resumes where there is something to resume, in an order of its own.
Run run_once(const RenderJob& job, const render::Scene& scene, const std::filesystem::path& path) {
  RenderJournal journal(path, job, ExistingJournal::resume);
  const std::vector<render::Rect> all = tiles_of(job, 3);
  const std::vector<render::Rect> tiles = open_tiles(all, journal.mark_open(all));
  Mosaic mosaic(job, tiles);
  journal.restore(mosaic);
  const TileWork work(scene, job, tiles);
  std::vector<std::uint32_t> order(tiles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(static_cast<std::uint32_t>(tiles.size())));
  Run run{tiles.size(), {}, journal.file().is_resumed() ? journal.resumed_rays() : 0};
  for (const std::uint32_t i : order) {
    mosaic.accept(scheduler::TaskId{i}, work(scheduler::TaskId{i}, [] {}));
    journal.add(tiles[i], mosaic.rays()[i], mosaic);
    run.rays += mosaic.rays()[i].total();
  }
  BOOST_TEST(mosaic.complete_rows() == job.area.height);
  run.files = files_of(job, mosaic);
  return run;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(RenderJournalTest)

BOOST_AUTO_TEST_CASE(a_finished_journal_is_the_whole_picture) {
  const TempFolder folder;
  const RenderJob job = tiny_job();
  const render::Scene scene(job.scene, job.kernel);
  const std::string reference = test::reference_files(job, scene);
  const Run first = run_once(job, scene, folder / "j");
  BOOST_TEST(first.open == 1u);
  BOOST_TEST((first.files == reference));
  const Run second = run_once(job, scene, folder / "j");
  BOOST_TEST(second.open == 0u);
  BOOST_TEST((second.files == reference));
  BOOST_TEST(second.rays == first.rays);
}

// The heart of it: wherever the file ends, the next run makes the same files, and its own journal is good as well.
BOOST_AUTO_TEST_CASE(a_journal_cut_off_at_any_byte_resumes_to_the_same_files) {
  const TempFolder folder;
  RenderJob job = tiny_job();
  const render::Scene scene(job.scene, job.kernel);
  const std::string reference = test::reference_files(job, scene);
  job.tile_width = 5;
  job.tile_height = 4;
  run_once(job, scene, folder / "whole");
  const std::string whole = slurp(folder / "whole");
  job.tile_width = 4;
  job.tile_height = 3;
  bool some_were_open = false;
  bool some_were_closed = false;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    folder.write("j", whole.substr(0, size));
    const Run resumed = run_once(job, scene, folder / "j");
    BOOST_TEST_REQUIRE((resumed.files == reference), "cut off after " << size << " bytes");
    some_were_open = some_were_open || (resumed.open > 0 && resumed.open < 4);
    some_were_closed = some_were_closed || resumed.open == 0;
    const Run again = run_once(job, scene, folder / "j");
    BOOST_TEST_REQUIRE(again.open == 0u);
    BOOST_TEST_REQUIRE((again.files == reference), "cut off after " << size << " bytes, second time");
  }
  BOOST_TEST(some_were_open);
  BOOST_TEST(some_were_closed);
}

BOOST_AUTO_TEST_CASE(a_flipped_bit_in_the_records_costs_time_but_no_pixel) {
  const TempFolder folder;
  RenderJob job = tiny_job();
  const render::Scene scene(job.scene, job.kernel);
  const std::string reference = test::reference_files(job, scene);
  job.tile_width = job.tile_height = 3;
  run_once(job, scene, folder / "whole");
  const std::string whole = slurp(folder / "whole");
  for (std::size_t byte = io::kJournalHeaderBytes; byte != whole.size(); ++byte) {
    std::string flipped = whole;
    flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << byte % 8));
    folder.write("j", flipped);
    const Run resumed = run_once(job, scene, folder / "j");
    BOOST_TEST_REQUIRE(resumed.open > 0u);
    BOOST_TEST_REQUIRE((resumed.files == reference), "byte " << byte);
  }
}

BOOST_AUTO_TEST_CASE(every_sharing_resumes_what_another_began) {
  const TempFolder folder;
  RenderJob job = tiny_job();
  const render::Scene scene(job.scene, job.kernel);
  const std::string reference = test::reference_files(job, scene);
  job.tile_width = job.tile_height = 3;
  run_once(job, scene, folder / "whole");
  const std::string whole = slurp(folder / "whole");
  for (const test::Sharing& sharing : test::all_sharings(job)) {
    sharing.apply_to(job);
    folder.write("j", whole.substr(0, 2 * whole.size() / 3));
    BOOST_TEST((run_once(job, scene, folder / "j").files == reference), sharing.text());
  }
}

BOOST_AUTO_TEST_CASE(the_hash_is_of_what_decides_pixels_and_of_nothing_else) {
  const RenderJob job = tiny_job();
  const std::uint64_t hash = picture_hash(job);
  const auto changed = [&](auto change) {
    RenderJob other = job;
    change(other);
    return picture_hash(other) != hash;
  };
  BOOST_TEST(changed([](RenderJob& j) { j.area.x += 1; }));
  BOOST_TEST(changed([](RenderJob& j) { j.format = render::PixelFormat::rgb16; }));
  BOOST_TEST(changed([](RenderJob& j) { j.layers.errors = false; }));
  BOOST_TEST(changed([](RenderJob& j) { j.tracer = render::Tracer::reference; }));
  BOOST_TEST(changed([](RenderJob& j) { j.scene.image.max_bounces = 1; }));
  BOOST_TEST(changed([](RenderJob& j) { j.scene.spheres.back().radius *= 2; }));
  BOOST_TEST(!changed([](RenderJob& j) { j.tile_width = 5; }));
  BOOST_TEST(!changed([](RenderJob& j) { j.kernel = render::Kernel::brute; }));
  BOOST_TEST(!changed([](RenderJob& j) { j.policy = scheduler::Policy::guided; }));
  BOOST_TEST(!changed([](RenderJob& j) { j.prefetch = 3; }));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::app
