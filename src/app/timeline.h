// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

#include "io/trace.h"
#include "render/image.h"
#include "render/ray_counts.h"
#include "scheduler/record.h"

// A run as a trace: who rendered which tile when, and when rank 0 handed it out and took it back.
namespace tessera::app {

/// A part of rank 0's way through a render.
/// units:   seconds since the render command began
struct Phase {
  std::string_view name;
  double begin_s = 0;
  double end_s = 0;
};

/// What there is to tell of a run.
/// shapes:  tiles, rays and run.tasks run in parallel
struct Timeline {
  const scheduler::RunRecord& run;
  double run_begin_s = 0;  ///< when run.clock started, since the render command began
  std::span<const render::Rect> tiles;
  std::span<const render::RayCounts> rays;
  std::span<const Phase> phases;
};

/// Process r is rank r. Its first thread has a slice per tile, on rank 0 within slices for the phases; rank 0's second
/// thread, "scheduling", has one for each hand-out and each acceptance. Arrows lead from a hand-out to its tiles and
/// from a tile to its acceptance, a counter falls with the tiles that are left. All times are those of rank 0's clock,
/// from the beginning of the render command. Only the beginning of a hand-out was measured: its slice lasts a
/// microsecond, or less where something follows. A tile of rank 0 lasts until rank 0 has its result, messages served in
/// between included. Where clocks went so unequally that an arrow would lead back in time, it is left out.
void write_timeline(const Timeline& timeline, const io::TraceWriter::Sink& sink);

}  // namespace tessera::app
