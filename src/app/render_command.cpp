// SPDX-License-Identifier: BSD-3-Clause
#include "app/render_command.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/failure.h"
#include "app/interruption.h"
#include "app/memory_use.h"
#include "app/open_tiles.h"
#include "app/progress.h"
#include "app/render_lead.h"
#include "app/shared_arrays.h"
#include "app/shared_tree.h"
#include "scheduler/clock_offset.h"
#include "scheduler/host.h"
#include "scheduler/launcher.h"
#include "scheduler/mpi/clock_offset.h"
#include "scheduler/mpi/farewell.h"
#include "scheduler/mpi/session.h"
#include "scheduler/mpi/transport.h"
#include "scheduler/run.h"
#include "scheduler/stopwatch.h"

namespace tessera::app {
namespace {

using scheduler::Stopwatch;
using scheduler::mpi::MpiTransport;
using scheduler::mpi::Session;

std::size_t pixels_of(std::span<const render::Rect> tiles) {
  std::size_t pixels = 0;
  for (const render::Rect& tile : tiles) pixels += tile.pixels();
  return pixels;
}

/// Rank 0's way through a render, whatever the others are: `run` carries out a plan.
template <class Run>
scheduler::RunRecord render_and_finish(RenderLead& lead, const RenderOptions& options, const render::Scene& scene,
                                       const Copies& copies, Run&& run) {
  lead.pulse();
  const RenderJob& job = lead.job();
  const auto tiles = lead.tiles();
  const scheduler::Plan plan = plan_of(job, tiles);
  const TileWork work(scene, job, tiles);
  Mosaic mosaic(job, tiles);
  lead.restore(mosaic);
  Progress progress(options.quiet ? ProgressStyle::none : options.progress, surroundings(), pixels_of(tiles));
  const auto accept = [&](scheduler::TaskId task, std::span<const std::byte> delivered) {
    mosaic.accept(task, delivered);
    const render::Rect& tile = tiles[index_of(task)];
    lead.keep(tile, mosaic.rays()[index_of(task)], mosaic);
    progress.advance(tile.pixels());
  };
  const scheduler::RunRecord record = run(plan, work, accept, [&] { lead.pulse(); });
  progress.finish();
  lead.memory() = memory_of(scene, copies);
  lead.finish(mosaic, tiles, record);
  return record;
}

/// The same where the journal has the whole picture: there is nothing to do for anybody else.
void finish_from_journal(RenderLead& lead, const Team& team) {
  Mosaic mosaic(lead.job(), {});
  lead.restore(mosaic);
  scheduler::RunRecord record;
  record.ranks.resize(team.ranks);
  for (scheduler::Rank rank = 0; rank != team.ranks; ++rank) record.ranks[rank].rank = rank;
  record.ranks[scheduler::kMasterRank].host = scheduler::host_name();
  lead.finish(mosaic, {}, record);
}

ExitCode render_alone(const RenderOptions& options, const std::string& command_line) {
  const Stopwatch total;
  const Team team;
  RenderLead lead(options, command_line, team, total);
  if (lead.is_rendered()) {
    finish_from_journal(lead, team);
    return ExitCode::success;
  }
  const Stopwatch build;
  const render::Scene scene(lead.take_scene(), lead.job().kernel);
  lead.end_phase(kBuild, build);
  render_and_finish(lead, options, scene, {}, [](const auto& plan, const auto&... work_accept_pulse) {
    return scheduler::run_in_process(1, 0, plan, work_accept_pulse...);
  });
  return ExitCode::success;
}

/// What rank 0 tells the others at the start: how reading went, and whether there is anything to render. If so, the job
/// follows, then which of its tiles are open, then the arrays.
struct Opening {
  std::int64_t code;          ///< an ExitCode
  std::uint64_t is_rendered;  ///< 1: nothing is left to do
};
static_assert(std::has_unique_object_representations_v<Opening> && sizeof(Opening) == 16);

std::span<std::byte> bytes_of(Opening& opening) noexcept {
  return std::as_writable_bytes(std::span(&opening, 1));
}

/// A job's scene with a tree that the ranks of each node have built together.
render::Scene shared_scene(Session& session, const RenderJob& job, const SceneArrays& arrays) {
  const bool needs_tree = render::runnable(job.kernel) != render::Kernel::brute;
  render::Bvh tree = needs_tree ? build_on_node(session, arrays.spheres) : render::Bvh();
  return {arrays.spheres, arrays.materials, job.scene, job.kernel, std::move(tree)};
}

ExitCode lead_ranks(Session& session, const RenderOptions& options, const std::string& command_line) {
  const Stopwatch total;
  const Team team{session.size(), session.nodes(), session.library()};
  std::optional<RenderLead> lead;
  ExitCode code = ExitCode::success;
  try {
    lead.emplace(options, command_line, team, total);
  } catch (...) {
    code = report_failure();
  }
  const Stopwatch broadcast;
  Opening opening{static_cast<int>(code), lead && lead->is_rendered()};
  session.broadcast(bytes_of(opening));
  if (!lead) return code;
  if (lead->is_rendered()) {
    finish_from_journal(*lead, team);
    return ExitCode::success;
  }
  lead->pulse();
  render::SceneData whole = lead->take_scene();
  scheduler::Bytes job = encode_job(lead->job());
  session.broadcast(job);
  scheduler::Bytes open_marks = lead->open_marks();
  session.broadcast(open_marks);
  const SceneArrays arrays = share_arrays(session, std::move(whole.spheres), std::move(whole.materials));
  lead->end_phase(kBroadcast, broadcast);

  const Stopwatch build;
  const render::Scene scene = shared_scene(session, lead->job(), arrays);
  MpiTransport transport(session);
  lead->end_phase(kBuild, build);
  const scheduler::RunRecord record =
      render_and_finish(*lead, options, scene, arrays.copies, [&](const auto& plan, const auto&... work_accept_pulse) {
        // Not before the picture has its memory: here all ranks' clocks start.
        session.barrier();
        const Stopwatch clock;
        std::vector<scheduler::ClockOffset> offsets;
        if (lead->job().compares_clocks) offsets = measure_clock_offsets(session, clock);
        scheduler::RunRecord run = scheduler::run_master(transport, plan, work_accept_pulse..., clock);
        if (!offsets.empty()) set_clock_offsets(run, offsets, clock);
        return run;
      });
  scheduler::mpi::dismiss(session, record);
  return ExitCode::success;
}

ExitCode follow(Session& session) {
  Opening opening{};
  session.broadcast(bytes_of(opening));
  const auto code = static_cast<ExitCode>(opening.code);
  if (code != ExitCode::success || opening.is_rendered == 1) return code;
  scheduler::Bytes bytes;
  session.broadcast(bytes);
  const RenderJob job = decode_job(bytes);
  scheduler::Bytes open_marks;
  session.broadcast(open_marks);
  const SceneArrays arrays = share_arrays(session, {}, {});

  const render::Scene scene = shared_scene(session, job, arrays);
  const auto tiles = open_tiles(tiles_of(job, session.size()), open_marks);
  const TileWork work(scene, job, tiles, session.nodes() > 1 ? Packing::where_shorter : Packing::never);
  MpiTransport transport(session);
  session.barrier();
  const Stopwatch clock;
  if (job.compares_clocks) measure_clock_offsets(session, clock);
  scheduler::run_worker(transport, plan_of(job, tiles), work, clock);
  scheduler::mpi::await_dismissal(session);
  return ExitCode::success;
}

}  // namespace

ExitCode run_render(const RenderOptions& options, const std::string& command_line, int& argc, char**& argv) {
  const bool leads = scheduler::launched_rank() == scheduler::kMasterRank;
  const SignalWatch signals(leads ? OnSignal::note : OnSignal::end_soon);
  if (!scheduler::launched_by_mpi()) return render_alone(options, command_line);
  Session session(argc, argv);
  try {
    return session.rank() == scheduler::kMasterRank ? lead_ranks(session, options, command_line) : follow(session);
  } catch (...) {
    // The other ranks would wait for this one for ever.
    session.abort(static_cast<int>(report_failure()));
  }
}

}  // namespace tessera::app
