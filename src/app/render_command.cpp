// SPDX-License-Identifier: BSD-3-Clause
#include "app/render_command.h"

#include <optional>

#include "app/failure.h"
#include "app/progress.h"
#include "app/render_lead.h"
#include "scheduler/launcher.h"
#include "scheduler/mpi/session.h"
#include "scheduler/mpi/transport.h"
#include "scheduler/run.h"
#include "scheduler/stopwatch.h"

namespace tessera::app {
namespace {

using scheduler::Stopwatch;
using scheduler::mpi::MpiTransport;
using scheduler::mpi::Session;

/// Rank 0's way through a render, whatever the others are: `run` carries out a plan.
template <class Run>
void render_and_finish(RenderLead& lead, const RenderOptions& options, const Team& team, const render::Scene& scene,
                       const Stopwatch& total, Run&& run) {
  const RenderJob& job = lead.job();
  const auto tiles = tiles_of(job, team.ranks);
  const scheduler::Plan plan = plan_of(job, tiles);
  const TileWork work(scene, job, tiles);
  Mosaic mosaic(job, tiles);
  Progress progress(options.quiet ? ProgressStyle::none : options.progress, surroundings(), job.area.pixels());
  const auto accept = [&](scheduler::TaskId task, std::span<const std::byte> delivered) {
    mosaic.accept(task, delivered);
    lead.pack(mosaic);
    progress.advance(tiles[index_of(task)].pixels());
  };
  const scheduler::RunRecord record = run(plan, work, accept);
  progress.finish();
  lead.finish(mosaic, tiles, record, total);
}

ExitCode render_alone(const RenderOptions& options, const std::string& command_line) {
  const Stopwatch total;
  const Team team;
  RenderLead lead(options, command_line, team);
  const Stopwatch build;
  const render::Scene scene(lead.job().scene, lead.job().kernel);
  lead.times().build = build.seconds();
  render_and_finish(lead, options, team, scene, total, [](const auto& plan, const auto& work, const auto& accept) {
    return scheduler::run_in_process(1, 0, plan, work, accept);
  });
  return ExitCode::success;
}

/// What rank 0 tells the others at the start: one byte that says how reading went, then the job if it went well.
scheduler::Bytes opening(ExitCode code, const RenderJob* job) {
  scheduler::Bytes bytes{static_cast<std::byte>(code)};
  if (job != nullptr) {
    const scheduler::Bytes encoded = encode_job(*job);
    bytes.insert(bytes.end(), encoded.begin(), encoded.end());
  }
  return bytes;
}

ExitCode lead_ranks(Session& session, const RenderOptions& options, const std::string& command_line) {
  const Stopwatch total;
  const Team team{session.size(), session.nodes(), session.library()};
  std::optional<RenderLead> lead;
  ExitCode code = ExitCode::success;
  try {
    lead.emplace(options, command_line, team);
  } catch (...) {
    code = report_failure();
  }
  const Stopwatch broadcast;
  scheduler::Bytes bytes = opening(code, lead ? &lead->job() : nullptr);
  session.broadcast(bytes);
  if (!lead) return code;
  lead->times().broadcast = broadcast.seconds();

  const Stopwatch build;
  const render::Scene scene(lead->job().scene, lead->job().kernel);
  MpiTransport transport(session);
  session.barrier();
  lead->times().build = build.seconds();
  render_and_finish(*lead, options, team, scene, total, [&](const auto& plan, const auto& work, const auto& accept) {
    return scheduler::run_master(transport, plan, work, accept);
  });
  return ExitCode::success;
}

ExitCode follow(Session& session) {
  scheduler::Bytes bytes;
  session.broadcast(bytes);
  const auto code = static_cast<ExitCode>(bytes.at(0));
  if (code != ExitCode::success) return code;

  RenderJob job = decode_job(std::span(bytes).subspan(1));
  bytes = {};
  const render::Scene scene(std::move(job.scene), job.kernel);
  const auto tiles = tiles_of(job, session.size());
  const TileWork work(scene, job, tiles);
  MpiTransport transport(session);
  session.barrier();
  scheduler::run_worker(transport, work);
  return ExitCode::success;
}

}  // namespace

ExitCode run_render(const RenderOptions& options, const std::string& command_line, int& argc, char**& argv) {
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
