// SPDX-License-Identifier: BSD-3-Clause
#include "app/render_lead.h"

#include <cstdio>
#include <stdexcept>
#include <utility>

#include "app/cost_map.h"
#include "app/cut_to_cost.h"
#include "app/exit_code.h"
#include "app/framing.h"
#include "app/interruption.h"
#include "app/open_tiles.h"
#include "app/report.h"
#include "app/shared_names.h"
#include "app/tile_size.h"
#include "app/version.h"
#include "io/error.h"
#include "io/image_file.h"
#include "io/pfm.h"
#include "io/scene_reader.h"
#include "io/signature_file.h"
#include "io/tile_times.h"
#include "render/check.h"
#include "render/scale.h"
#include "scheduler/grain.h"

namespace tessera::app {
namespace {

constexpr std::uint64_t kMaxTiles = 100'000'000;

/// Below that, handing tiles out takes rank 0 longer than bands lose by being unequal.
constexpr double kLeastWorkRatio = 3;

/// A sample in quad precision takes as long as so many.
constexpr double kReferenceSamples = 1e4;

const io::PngText kText{{"Software", "Tessera"}};

io::ImageFormat format_of(const std::filesystem::path& output) {
  const auto format = io::image_format_of(output);
  if (!format) {
    throw UsageError("-o: \"" + output.string() + "\" has no ending that we write, use " +
                     std::string(io::kImageEndings));
  }
  return *format;
}

std::uint64_t tiles_along(std::uint32_t length, std::uint32_t tile) {
  return (std::uint64_t{length} + tile - 1) / tile;
}

}  // namespace

RenderLead::RenderLead(const RenderOptions& options, std::string command_line, const Team& team,
                       const scheduler::Stopwatch& total)
    : options_(options), team_(team), total_(total) {
  stats_.version = kVersion;
  stats_.command = std::move(command_line);
  const io::ImageFormat format = format_of(options.output);
  if (format == io::ImageFormat::pfm && options.bits == 16) {
    throw UsageError("--bits does not go with .pfm (its channels are 32-bit floats)");
  }
  if (options.signature && *options.signature == "-") {
    throw UsageError("--signature: \"-\" is not a file (signatures are no text)");
  }
  if (options.error && io::image_format_of(*options.error) != io::ImageFormat::pfm) {
    throw UsageError("--error: \"" + options.error->string() + "\" must end in .pfm (bounds are floats)");
  }
  if (options.error && options.tracer == render::Tracer::reference) {
    throw UsageError("--error does not go with --reference (it bounds how far a picture is from that one)");
  }
  ScheduleFiles::check(options);
  job_.format = io::pixel_format_for(format, options.bits == 16 ? io::BitDepth::sixteen : io::BitDepth::eight);

  const scheduler::Stopwatch read;
  read_scene();
  end_phase(kRead, read);
  const render::SceneData& scene = job_.scene;
  stats_.scene = {scene.spheres.size(), scene.planes.size(), scene.lights.size(), scene.materials.size()};
  plan_schedule();
  open_outputs();
  find_open_tiles();
}

render::SceneData RenderLead::take_scene() {
  return {job_.scene, std::exchange(job_.scene.spheres, {}), std::exchange(job_.scene.materials, {})};
}

void RenderLead::read_scene() {
  io::ReadScene read = io::read_scene(options_.input);
  job_.scene = std::move(read.scene);
  notes_ = std::move(read.notes);

  // The command line wins over the scene.
  render::ImageSettings& image = job_.scene.image;
  if (options_.resolution) {
    image.width = options_.resolution->width;
    image.height = options_.resolution->height;
  }
  image.samples = options_.samples.value_or(image.samples);
  image.max_bounces = options_.max_bounces.value_or(image.max_bounces);
  image.transfer = options_.transfer.value_or(image.transfer);
  image.shade = options_.shade.value_or(image.shade);
  if (const auto problem = problem_with(image)) throw UsageError(*problem);

  job_.area = options_.crop.value_or(render::Rect{0, 0, image.width, image.height});
  const auto fits = [](std::uint64_t begin, std::uint64_t length, std::uint32_t side) {
    return begin + length <= side;
  };
  if (!fits(job_.area.x, job_.area.width, image.width) || !fits(job_.area.y, job_.area.height, image.height)) {
    throw UsageError("--crop reaches out of the picture (it is " + std::to_string(image.width) + "x" +
                     std::to_string(image.height) + ")");
  }
  if (const auto problem = problem_with_span(job_.scene)) {
    throw io::Error(io::ErrorKind::bad_scene, options_.input.string() + ": " + *problem);
  }
  job_.scene = unit_scaled(std::move(job_.scene));
  require_camera(job_.scene, options_.input);
}

void RenderLead::plan_schedule() {
  job_.kernel = options_.kernel;
  job_.tracer = options_.tracer;
  job_.layers = {options_.signature.has_value(), options_.error.has_value()};
  job_.policy = options_.policy;
  job_.master = options_.master;
  job_.prefetch = options_.prefetch;
  job_.ask_back = options_.ask_back;
  job_.lease_s = options_.lease_s;
  const double samples = job_.scene.image.samples * (job_.tracer == render::Tracer::reference ? kReferenceSamples : 1);
  const Size size = options_.tile.value_or(tile_size_without_costs(job_.area, samples));
  job_.tile_width = size.width;
  job_.tile_height = size.height;
  job_.compares_clocks = options_.trace.has_value();
  if (tiles_along(job_.area.width, job_.tile_width) * tiles_along(job_.area.height, job_.tile_height) > kMaxTiles) {
    throw UsageError("--tile-size cuts the picture into more than 100 million tiles, use larger ones");
  }
  if (options_.costs) {
    plan_by_costs();
  } else if (!options_.tile && bands_will_do(job_.area, samples, team_.ranks)) {
    fall_back_to_bands();
  }
  const scheduler::Plan plan = plan_of(job_, tiles_of(job_, team_.ranks));
  try {
    require_feasible(plan, team_.ranks);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  job_.master = settled_role(plan, team_.ranks);
}

void RenderLead::plan_by_costs() {
  if (has_owners(job_.policy)) {
    throw UsageError("--costs does not go with --schedule " + std::string(name_of(job_.policy)) +
                     " (which rank renders what does not depend on it)");
  }
  const render::ImageSettings& image = job_.scene.image;
  const CostMap costs(io::read_tile_times(*options_.costs), job_.area, {0, 0, image.width, image.height},
                      options_.costs->string());
  if (options_.tile) {
    for (const render::Rect& tile : tiles_of(job_, team_.ranks)) job_.cut.push_back({tile, costs.seconds(tile)});
  } else if (scheduler::work_ratio(costs.seconds(), team_.ranks) < kLeastWorkRatio) {
    fall_back_to_bands();
  } else {
    const auto seconds_of = [&](const render::Rect& rect) { return costs.seconds(rect); };
    job_.cut = cut_to_cost(job_.area, seconds_of, team_.ranks);
  }
}

void RenderLead::fall_back_to_bands() {
  const bool can = job_.policy == scheduler::Policy::dynamic && job_.master != scheduler::MasterRole::dedicated;
  if (can) job_.policy = scheduler::Policy::static_bands;
}

void RenderLead::open_outputs() {
  refuse_shared_names({{"INPUT", options_.input},
                       {"-o", options_.output},
                       {"--journal", options_.journal},
                       {"--signature", options_.signature},
                       {"--error", options_.error},
                       {"--stats", options_.stats},
                       {"--tile-stats", options_.tile_stats},
                       {"--trace", options_.trace},
                       {"--cost-map", options_.cost_map},
                       {"--owner-map", options_.owner_map}});
  picture_.emplace(options_.output);
  if (format_of(options_.output) == io::ImageFormat::png) {
    png_.emplace(io::PngHeader{job_.area.width, job_.area.height, job_.format, job_.scene.image.transfer}, kText);
  }
  if (options_.signature) signature_file_.emplace(*options_.signature);
  if (options_.error) error_file_.emplace(*options_.error);
  if (options_.stats) stats_file_.emplace(*options_.stats);
  if (options_.tile_stats) tile_stats_file_.emplace(*options_.tile_stats);
  schedule_files_.emplace(options_);
  if (options_.journal) {
    journal_.emplace(*options_.journal, job_,
                     options_.resume ? io::ExistingJournal::resume : io::ExistingJournal::refuse);
    if (options_.resume && !journal_->file().is_resumed()) {
      notes_.push_back(options_.journal->string() + " was not there to resume from: all is rendered anew");
    }
  }
}

void RenderLead::find_open_tiles() {
  if (!journal_ || !journal_->file().is_resumed()) return;
  const std::vector<render::Rect> all = tiles_of(job_, team_.ranks);
  open_marks_ = journal_->mark_open(all);
  const std::vector<render::Rect> open = tiles();
  is_rendered_ = open.empty();
  std::size_t resumed_pixels = job_.area.pixels();
  for (const render::Rect& tile : open) resumed_pixels -= tile.pixels();
  stats_.resumed = {all.size() - open.size(), resumed_pixels, journal_->resumed_rays()};
}

std::vector<render::Rect> RenderLead::tiles() const {
  return open_tiles(tiles_of(job_, team_.ranks), open_marks_);
}

void RenderLead::restore(Mosaic& mosaic) const {
  if (journal_) journal_->restore(mosaic);
}

void RenderLead::keep(const render::Rect& tile, const render::RayCounts& rays, const Mosaic& mosaic) {
  if (journal_) journal_->add(tile, rays, mosaic);
  if (png_ && team_.ranks > 1) pack_rows(mosaic);
}

void RenderLead::pulse() {
  if (const int signal = pending_signal(); signal != 0) {
    if (!journal_) throw Interrupted(signal, "nothing is kept; with --journal FILE a run can be resumed");
    journal_->file().flush();
    if (!journal_->file().has_records()) throw Interrupted(signal, "nothing was rendered yet");
    throw Interrupted(signal, options_.journal->string() + " keeps what was rendered; add --resume to go on from it");
  }
  if (journal_) journal_->file().tick();
}

void RenderLead::pack_rows(const Mosaic& mosaic) {
  const std::size_t row_bytes = mosaic.image().width * bytes_per_pixel(mosaic.image().format);
  const std::uint32_t complete = mosaic.complete_rows();
  const std::span<const std::byte> all = mosaic.image().bytes;
  png_->add_rows(all.subspan(packed_rows_ * row_bytes, (complete - packed_rows_) * row_bytes));
  packed_rows_ = complete;
}

void RenderLead::add_phase(const PhaseKind& kind, const scheduler::Stopwatch& phase, double seconds) {
  stats_.time_s.*kind.time = seconds;
  const double begin_s = phase.seconds_after(total_);
  phases_.push_back({kind.name, begin_s, begin_s + seconds});
}

void RenderLead::finish(const Mosaic& mosaic, std::span<const render::Rect> tiles, const scheduler::RunRecord& run) {
  add_phase(kRender, run.clock, run.makespan_s);
  const scheduler::Stopwatch write;
  if (journal_) journal_->file().flush();
  if (png_) {
    pack_rows(mosaic);
    picture_->write(std::move(*png_).finish());
  } else {
    picture_->write(io::encode_image(format_of(options_.output), mosaic.image(), job_.scene.image.transfer, kText));
  }
  if (signature_file_) signature_file_->write(io::encode_signatures(mosaic.signatures()));
  if (error_file_) error_file_->write(io::encode_pfm(job_.area.width, job_.area.height, mosaic.errors()));
  end_phase(kWrite, write);
  stats_.time_s.total = total_.seconds();

  fill_stats(stats_, job_, team_, tiles, mosaic, run);
  if (stats_file_) stats_file_->write(to_json(stats_));
  if (tile_stats_file_) tile_stats_file_->write(tile_stats_csv(tile_rows(tiles, mosaic.rays(), run)));
  pulse();
  schedule_files_->write({run, run.clock.seconds_after(total_), tiles, mosaic.rays(), phases_}, job_.area);
  // No file gets its name before all of them are written.
  picture_->commit();
  if (signature_file_) signature_file_->commit();
  if (error_file_) error_file_->commit();
  if (stats_file_) stats_file_->commit();
  if (tile_stats_file_) tile_stats_file_->commit();
  schedule_files_->commit();
  if (journal_) journal_->file().remove();
  if (options_.quiet) return;
  for (const std::string& note : notes_) std::fprintf(stderr, "note: %s\n", note.c_str());
  print_report(stats_, options_);
}

}  // namespace tessera::app
