// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options.h"
#include "app/render_job.h"
#include "app/report.h"
#include "app/text_output.h"
#include "io/output_file.h"
#include "io/png.h"
#include "io/stats.h"
#include "scheduler/record.h"
#include "scheduler/stopwatch.h"

// What rank 0 does besides its share of the tiles: it reads the scene, checks that every output can be written, and
// at the end writes the picture, the statistics and the report.
namespace tessera::app {

class RenderLead {
 public:
  /// Reads the scene, decides on the tiles and opens the outputs.
  /// throws:  UsageError, io::Error
  RenderLead(const RenderOptions& options, std::string command_line, const Team& team);

  const RenderJob& job() const noexcept { return job_; }

  /// The scene to render. Its spheres and materials, which may be too many to have twice, are given away: the job is
  /// one without them from then on.
  render::SceneData take_scene();

  /// Phases that are timed elsewhere go in here.
  io::Stats::Times& times() noexcept { return stats_.time_s; }
  /// The same of memory.
  io::Stats::Memory& memory() noexcept { return stats_.memory; }

  /// Packs what is complete of the picture, so that little is left to do at the end. With one rank that is no gain, and
  /// it would count as rendering.
  void pack(const Mosaic& mosaic);

  /// Writes every output and prints the report; `total` started with the render command.
  /// throws:  io::Error
  void finish(const Mosaic& mosaic, std::span<const render::Rect> tiles, const scheduler::RunRecord& run,
              const scheduler::Stopwatch& total);

 private:
  void read_scene();
  void plan_schedule();
  /// Cuts the picture to what its parts are predicted to cost, or predicts what tiles of a given size cost.
  void plan_by_costs();
  /// Where nobody asked for another way.
  void fall_back_to_bands();
  void open_outputs();
  void pack_rows(const Mosaic& mosaic);

  const RenderOptions& options_;
  Team team_;
  RenderJob job_;
  io::Stats stats_;
  std::vector<std::string> notes_;
  std::optional<io::OutputFile> picture_;
  std::optional<io::PngEncoder> png_;  ///< where the picture is to be one
  std::uint32_t packed_rows_ = 0;
  std::optional<io::OutputFile> signature_file_;
  std::optional<io::OutputFile> error_file_;
  std::optional<TextOutput> stats_file_;
  std::optional<TextOutput> tile_stats_file_;
};

}  // namespace tessera::app
