// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/options.h"
#include "app/render_job.h"
#include "app/render_journal.h"
#include "app/report.h"
#include "app/schedule_files.h"
#include "app/text_output.h"
#include "app/timeline.h"
#include "io/output_file.h"
#include "io/png.h"
#include "io/stats.h"
#include "scheduler/record.h"
#include "scheduler/stopwatch.h"

// What rank 0 does besides its share of the tiles: it reads the scene, checks that every output can be written, keeps
// the journal, and at the end writes the picture, the statistics and the report.
namespace tessera::app {

/// A part of a render that is timed: its name and where the statistics keep its time.
struct PhaseKind {
  std::string_view name;
  double io::Stats::Times::*time;
};

inline constexpr PhaseKind kRead{"read", &io::Stats::Times::read};
inline constexpr PhaseKind kBroadcast{"broadcast", &io::Stats::Times::broadcast};
inline constexpr PhaseKind kBuild{"build", &io::Stats::Times::build};
inline constexpr PhaseKind kRender{"render", &io::Stats::Times::render};
inline constexpr PhaseKind kWrite{"write", &io::Stats::Times::write};

class RenderLead {
 public:
  /// Reads the scene, decides on the tiles and opens the outputs; `total` started with the render command.
  /// throws:  UsageError, io::Error
  RenderLead(const RenderOptions& options, std::string command_line, const Team& team,
             const scheduler::Stopwatch& total);

  const RenderJob& job() const noexcept { return job_; }

  /// The scene to render. Its spheres and materials, which may be too many to have twice, are given away: the job is
  /// one without them from then on.
  render::SceneData take_scene();

  /// Takes down a phase that ends now and began with its stopwatch.
  void end_phase(const PhaseKind& kind, const scheduler::Stopwatch& phase) { add_phase(kind, phase, phase.seconds()); }
  /// What the scene takes goes in here.
  io::Stats::Memory& memory() noexcept { return stats_.memory; }

  /// Which tiles must be rendered, a bit for each: see open_tiles.h.
  const scheduler::Bytes& open_marks() const noexcept { return open_marks_; }
  std::vector<render::Rect> tiles() const;
  /// Whether there are none.
  bool is_rendered() const noexcept { return is_rendered_; }

  /// Puts what earlier runs finished in its place.
  /// throws:  io::Error
  void restore(Mosaic& mosaic) const;

  /// To be called when the mosaic has accepted a tile: keeps it in the journal, and packs what is complete of the
  /// picture, so that little is left to do at the end. With one rank packing is no gain, and would count as rendering.
  /// throws:  io::Error
  void keep(const render::Rect& tile, const render::RayCounts& rays, const Mosaic& mosaic);

  /// To be called often, as long as there is something to render or write: keeps the journal going, and ends the
  /// program if somebody wants that.
  /// throws:  Interrupted, io::Error
  void pulse();

  /// Writes every output and prints the report.
  /// throws:  Interrupted, io::Error
  void finish(const Mosaic& mosaic, std::span<const render::Rect> tiles, const scheduler::RunRecord& run);

 private:
  void read_scene();
  void plan_schedule();
  /// Cuts the picture to what its parts are predicted to cost, or predicts what tiles of a given size cost.
  void plan_by_costs();
  /// Where nobody asked for another way.
  void fall_back_to_bands();
  void open_outputs();
  void find_open_tiles();
  void pack_rows(const Mosaic& mosaic);
  void add_phase(const PhaseKind& kind, const scheduler::Stopwatch& phase, double seconds);

  const RenderOptions& options_;
  Team team_;
  scheduler::Stopwatch total_;
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
  std::optional<ScheduleFiles> schedule_files_;
  std::vector<Phase> phases_;
  std::optional<RenderJournal> journal_;  ///< opened last: what fails before leaves none behind
  scheduler::Bytes open_marks_;
  bool is_rendered_ = false;
};

}  // namespace tessera::app
