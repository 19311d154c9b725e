// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/options.h"
#include "app/render_job.h"
#include "io/stats.h"
#include "scheduler/record.h"

// What a run says of itself: as statistics for scripts and as a few lines for a person.
namespace tessera::app {

/// The ranks that render.
struct Team {
  std::uint32_t ranks = 1;
  std::uint32_t nodes = 1;
  std::string library;  ///< what implements MPI, empty without a launcher
};

/// Fills in all but version, command and times.
/// shapes:  tiles, the mosaic's rays and run.tasks run in parallel
void fill_stats(io::Stats& stats, const RenderJob& job, const Team& team, std::span<const render::Rect> tiles,
                const Mosaic& mosaic, const scheduler::RunRecord& run);

/// One row per tile.
std::vector<io::TileRow> tile_rows(std::span<const render::Rect> tiles, std::span<const render::RayCounts> rays,
                                   const scheduler::RunRecord& run);

/// Prints the end-of-run report on stderr.
void print_report(const io::Stats& stats, const RenderOptions& options);

}  // namespace tessera::app
