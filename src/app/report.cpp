// SPDX-License-Identifier: BSD-3-Clause
#include "app/report.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <thread>

#include "scheduler/metrics.h"
#include "scheduler/policy.h"

namespace tessera::app {
namespace {

constexpr std::size_t kRanksShown = 16;

/// "1.234 s" or "5.67 ms".
std::string duration(double seconds) {
  char text[32];
  if (seconds >= 0.1 || seconds == 0) {
    std::snprintf(text, sizeof text, "%.3f s", seconds);
  } else {
    std::snprintf(text, sizeof text, "%.3g ms", 1e3 * seconds);
  }
  return text;
}

void print_ranks(const io::Stats& stats, bool all) {
  const std::size_t shown = all ? stats.ranks.size() : std::min(stats.ranks.size(), kRanksShown);
  std::fprintf(stderr, "  rank  host              tiles         rays        busy        wait\n");
  for (std::size_t i = 0; i != shown; ++i) {
    const auto& rank = stats.ranks[i];
    std::fprintf(stderr, "  %4u  %-14.14s %8" PRIu64 " %12" PRIu64 "  %10s  %10s\n", rank.rank, rank.host.c_str(),
                 rank.tiles, rank.rays, duration(rank.busy_s).c_str(), duration(rank.wait_s).c_str());
  }
  if (shown < stats.ranks.size()) {
    std::fprintf(stderr, "  ... and %zu more ranks, shown with -v\n", stats.ranks.size() - shown);
  }
}

/// What sharing the work took; nothing where no message was sent.
void print_messages(const io::Stats& stats) {
  if (stats.messages.count == 0) return;
  std::fprintf(stderr, "messages: %.2f and %.0f bytes a tile, rank 0 spent %.3g us on a result, ",
               stats.messages.per_tile, stats.messages.bytes_per_tile, 1e6 * stats.messages.master_s_per_tile);
  std::fprintf(stderr, "workers held %.1f tiles, at most %u\n", stats.schedule.prefetch_mean,
               stats.schedule.prefetch_most);
}

io::Stats::Error summary_of(std::span<const float> bounds) {
  io::Stats::Error error;
  for (const float bound : bounds) {
    if (std::isfinite(bound)) {
      error.largest = std::max(error.largest, static_cast<double>(bound));
    } else {
      ++error.uncertified;
    }
  }
  return error;
}

void print_faults(const io::Stats& stats) {
  const io::Stats::Faults& faults = stats.faults;
  if (faults.silences == 0 && faults.damaged == 0 && faults.lost.empty()) return;
  std::fprintf(stderr,
               "faults: ranks fell silent %" PRIu64 " times, %" PRIu64 " tiles arrived broken, %" PRIu64
               " tiles were handed out again, %s wasted\n",
               faults.silences, faults.damaged, faults.reissued, duration(faults.wasted_s).c_str());
  for (const std::uint32_t rank : faults.lost) {
    std::fprintf(stderr, "lost: rank %u on %s\n", rank, stats.ranks[rank].host.c_str());
  }
}

double mebibytes(std::uint64_t bytes) {
  return static_cast<double>(bytes) / (1 << 20);
}

/// A person who renders on one core of several may not know that there is more to have.
void print_unused_cores(const io::Stats& stats, const RenderOptions& options) {
  const unsigned cores = std::thread::hardware_concurrency();
  if (!stats.mpi.library.empty() || cores < 2) return;
  std::fprintf(stderr, "used 1 of %u cores; for all of them: mpirun -n %u tessera render %s\n", cores, cores,
               options.input.c_str());
}

}  // namespace

void fill_stats(io::Stats& stats, const RenderJob& job, const Team& team, std::span<const render::Rect> tiles,
                const Mosaic& mosaic, const scheduler::RunRecord& run) {
  const std::span<const render::RayCounts> rays = mosaic.rays();
  const render::SceneData& scene = job.scene;
  const scheduler::Overhead overhead = overhead_of(run);
  stats.image = {job.area.width, job.area.height, scene.image.samples, scene.image.max_bounces};
  stats.mpi = {team.ranks, team.nodes, team.library};
  stats.schedule = {std::string(name_of(job.policy)),
                    tiles.empty() ? job.tile_width : 0,
                    tiles.empty() ? job.tile_height : 0,
                    tiles.size(),
                    job.prefetch.value_or(0),
                    std::string(name_of(job.master)),
                    overhead.mean_held,
                    overhead.most_held};
  for (const render::Rect& tile : tiles) {
    stats.schedule.tile_width = std::max(stats.schedule.tile_width, tile.width);
    stats.schedule.tile_height = std::max(stats.schedule.tile_height, tile.height);
  }

  for (const scheduler::RankRecord& rank : run.ranks) {
    stats.ranks.push_back({rank.rank, rank.host, rank.tasks, 0, 0, rank.busy_s, rank.wait_s});
  }
  for (std::size_t i = 0; i != tiles.size(); ++i) {
    auto& rank = stats.ranks[run.tasks[i].rank];
    rank.pixels += tiles[i].pixels();
    rank.rays += rays[i].total();
    stats.rays.primary += rays[i].primary;
    stats.rays.shadow += rays[i].shadow;
    stats.rays.mirror += rays[i].mirror;
  }
  const scheduler::Balance balance = balance_of(run);
  stats.balance = {balance.imbalance, balance.load_balance,   balance.efficiency,
                   balance.tail_s,    balance.graham_bound_s, balance.makespan_s};
  stats.messages = {run.messages.count, run.messages.bytes, overhead.messages_per_task, overhead.bytes_per_task,
                    overhead.master_s_per_task};
  const scheduler::Faults& faults = run.faults;
  stats.faults = {faults.silences, faults.reissued, faults.damaged, faults.late, faults.returned, faults.wasted_s, {}};
  for (const scheduler::LostRank& lost : run.lost) stats.faults.lost.push_back(lost.rank);
  if (job.layers.errors) stats.error = summary_of(mosaic.errors());
}

std::vector<io::TileRow> tile_rows(std::span<const render::Rect> tiles, std::span<const render::RayCounts> rays,
                                   const scheduler::RunRecord& run) {
  std::vector<io::TileRow> rows;
  rows.reserve(tiles.size());
  for (std::size_t i = 0; i != tiles.size(); ++i) {
    const scheduler::TaskRecord& task = run.tasks[i];
    const double offset_s = run.ranks[task.rank].clock_offset_s;
    rows.push_back({index_of(task.task), tiles[i].x, tiles[i].y, tiles[i].width, tiles[i].height, task.rank,
                    task.start_s + offset_s, task.end_s + offset_s, rays[i].total(), task.bytes});
  }
  return rows;
}

void print_report(const io::Stats& stats, const RenderOptions& options) {
  std::fprintf(stderr, "%s: %ux%u, %u sample%s a pixel, %" PRIu64 " rays\n", options.output.c_str(), stats.image.width,
               stats.image.height, stats.image.samples, stats.image.samples == 1 ? "" : "s",
               stats.rays.primary + stats.rays.shadow + stats.rays.mirror);
  std::fprintf(stderr, "%s, %" PRIu64 " tile%s of %s%ux%u, %u rank%s on %u node%s\n", stats.schedule.policy.c_str(),
               stats.schedule.tiles, stats.schedule.tiles == 1 ? "" : "s",
               options.costs && !options.tile ? "up to " : "", stats.schedule.tile_width, stats.schedule.tile_height,
               stats.mpi.size, stats.mpi.size == 1 ? "" : "s", stats.mpi.nodes, stats.mpi.nodes == 1 ? "" : "s");
  if (stats.resumed) {
    const double pixels = static_cast<double>(stats.image.width) * stats.image.height;
    std::fprintf(stderr, "resumed: %" PRIu64 " more tile%s, %.1f %% of the pixels, from %s\n", stats.resumed->tiles,
                 stats.resumed->tiles == 1 ? "" : "s", 100 * static_cast<double>(stats.resumed->pixels) / pixels,
                 options.journal->c_str());
  }
  print_ranks(stats, options.verbose);
  std::fprintf(stderr,
               "load balance: efficiency %.1f %%, mean/max %.1f %%, imbalance %.1f %%, tail %s, makespan %s (Graham's "
               "bound %s)\n",
               100 * stats.balance.efficiency, 100 * stats.balance.load_balance, 100 * stats.balance.imbalance,
               duration(stats.balance.tail_s).c_str(), duration(stats.balance.makespan_s).c_str(),
               duration(stats.balance.graham_bound_s).c_str());
  print_messages(stats);
  print_faults(stats);
  const std::uint64_t pixels = std::uint64_t{stats.image.width} * stats.image.height;
  if (stats.error && stats.error->uncertified == pixels) {
    std::fprintf(stderr, "error: all pixels uncertified\n");
  } else if (stats.error) {
    std::fprintf(stderr, "error: at most %.2g of a linear channel, %" PRIu64 " pixel%s uncertified\n",
                 stats.error->largest, stats.error->uncertified, stats.error->uncertified == 1 ? "" : "s");
  }
  const auto& memory = stats.memory;
  std::fprintf(stderr, "memory: %.0f bytes a sphere, %.1f MiB a node, besides %.1f MiB on rank 0\n",
               memory.bytes_per_sphere, mebibytes(memory.node_bytes), mebibytes(memory.rank_bytes));
  const auto& t = stats.time_s;
  std::fprintf(stderr, "time: read %s, broadcast %s, build %s, render %s, write %s, total %s\n",
               duration(t.read).c_str(), duration(t.broadcast).c_str(), duration(t.build).c_str(),
               duration(t.render).c_str(), duration(t.write).c_str(), duration(t.total).c_str());
  print_unused_cores(stats, options);
}

}  // namespace tessera::app
