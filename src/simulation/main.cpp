// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "app/exit_code.h"
#include "app/render_job.h"
#include "io/error.h"
#include "io/stats.h"
#include "io/tile_stats_file.h"
#include "scheduler/clock.h"
#include "scheduler/metrics.h"
#include "scheduler/run.h"
#include "simulation/cost_map.h"
#include "simulation/options.h"
#include "simulation/replay.h"

// The scheduler's own program on a cluster that is not there: the same master, workers, policies and messages, but a
// tile only takes the time that it is known to take.
namespace tessera::simulation {
namespace {

/// What all ranks of a simulation know.
struct Setting {
  app::RenderJob job;
  std::vector<render::Rect> tiles;
  std::vector<CostMap::Cost> costs;
  scheduler::Plan plan;
};

Setting prepare(const SimulationOptions& options) {
  const CostMap map(options.costs ? io::read_tile_stats(*options.costs) : tiles_of(options.even));
  Setting setting;
  const app::Size size = options.resolution.value_or(app::Size{map.width(), map.height()});
  setting.job.area = {0, 0, size.width, size.height};
  setting.job.tile_width = options.tile.width;
  setting.job.tile_height = options.tile.height;
  setting.job.policy = options.policy;
  setting.job.master = options.master;
  setting.job.prefetch = options.prefetch;
  setting.tiles = app::tiles_of(setting.job, options.ranks);
  setting.plan = app::plan_of(setting.job, setting.tiles);
  setting.plan.lease_s = std::numeric_limits<double>::infinity();  // nobody dies here
  for (const render::Rect& tile : setting.tiles) {
    setting.costs.push_back(map.of(tile, setting.job.area));
    if (options.costs_are_known) setting.plan.costs.push_back(setting.costs.back().seconds);
  }
  require_feasible(setting.plan, options.ranks);
  return setting;
}

/// Rank 0's part: what happened, once every result is in.
scheduler::RunRecord lead(scheduler::Transport& carrier, const Setting& setting, const SimulationOptions& options) {
  ChargedTransport transport(carrier, options.master_cost, spend);
  Collection collection(setting.costs);
  const auto accept = [&](scheduler::TaskId task, auto delivered) { collection.accept(task, delivered); };
  auto record = run_master(transport, setting.plan, replay(setting.costs, options.master_slice_s, spend), accept);
  if (!collection.is_complete()) throw std::logic_error("the run is over, but results are missing");
  return record;
}

scheduler::RunRecord simulate(const Setting& setting, const SimulationOptions& options) {
  scheduler::RunRecord record;
  const scheduler::ClockInPlace clock(simulated_ns);
  run_cluster(options.ranks, options.network, [&](scheduler::Transport& transport) {
    if (transport.rank() == scheduler::kMasterRank) {
      record = lead(transport, setting, options);
    } else {
      run_worker(transport, setting.plan, replay(setting.costs, options.worker_slice_s, spend));
    }
  });
  return record;
}

void print(const Setting& setting, const scheduler::RunRecord& run, const SimulationOptions& options) {
  io::Stats stats;
  stats.command = "tessera_simulate";
  stats.image.width = setting.job.area.width;
  stats.image.height = setting.job.area.height;
  stats.mpi = {options.ranks, options.ranks, "SimGrid"};
  stats.schedule = {std::string(name_of(options.policy)),
                    setting.tiles[0].width,
                    setting.tiles[0].height,
                    setting.tiles.size(),
                    options.prefetch.value_or(0),
                    std::string(name_of(options.master))};
  stats.time_s.render = run.makespan_s;
  for (const scheduler::RankRecord& rank : run.ranks) {
    stats.ranks.push_back({rank.rank, "node" + std::to_string(rank.rank), rank.tasks, 0, 0, rank.busy_s, rank.wait_s});
  }
  std::vector<io::TileRow> rows;
  for (std::size_t i = 0; i != setting.tiles.size(); ++i) {
    const render::Rect& tile = setting.tiles[i];
    const scheduler::TaskRecord& task = run.tasks[i];
    stats.ranks[task.rank].pixels += tile.pixels();
    rows.push_back({i, tile.x, tile.y, tile.width, tile.height, task.rank, task.start_s, task.end_s, 0, task.bytes});
  }
  const scheduler::Balance balance = balance_of(run);
  stats.balance = {balance.imbalance, balance.load_balance,   balance.efficiency,
                   balance.tail_s,    balance.graham_bound_s, balance.makespan_s};
  stats.messages = {run.messages.count, run.messages.bytes};
  if (options.tile_stats) io::write_text(*options.tile_stats, io::tile_stats_csv(rows));
  io::write_text("-", to_json(stats));
}

app::ExitCode run(int argc, char** argv) {
  const auto parsed = parse_simulation(argc, argv);
  if (const auto* request = std::get_if<app::TextRequest>(&parsed)) {
    std::fputs(request->text.c_str(), stdout);
    return app::ExitCode::success;
  }
  const auto& options = std::get<SimulationOptions>(parsed);
  const Setting setting = prepare(options);
  print(setting, simulate(setting, options), options);
  return app::ExitCode::success;
}

}  // namespace
}  // namespace tessera::simulation

int main(int argc, char** argv) {
  using namespace tessera;
  using app::ExitCode;
  const auto fail = [](const std::exception& error, ExitCode code) {
    std::fprintf(stderr, "tessera_simulate: %s\n", error.what());
    return static_cast<int>(code);
  };
  try {
    return static_cast<int>(simulation::run(argc, argv));
  } catch (const app::UsageError& error) {
    return fail(error, ExitCode::usage);
  } catch (const std::invalid_argument& error) {
    return fail(error, ExitCode::usage);
  } catch (const io::Error& error) {
    return fail(error, error.kind() == io::ErrorKind::input_missing ? ExitCode::input_missing : ExitCode::io_failure);
  } catch (const std::exception& error) {
    return fail(error, ExitCode::internal);
  }
}
