// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "app/render_job.h"
#include "io/journal.h"
#include "scheduler/bytes.h"

namespace tessera::app {

/// A hash of all that decides a job's pixels: scene, image settings, area, format, layers, tracer, program version. How
/// the work is shared out and which kernel does it are not in it.
/// requires: the job has its spheres
std::uint64_t picture_hash(const RenderJob& job);

/// The journal of a render: the tiles that earlier runs finished, and those that this one finishes. Earlier runs may
/// have cut the picture into other tiles.
class RenderJournal {
 public:
  /// requires: the job has its spheres
  /// throws:  io::Error as io::Journal
  RenderJournal(const std::filesystem::path& path, const RenderJob& job, io::ExistingJournal existing);

  /// A bit for each tile, set where it must be rendered, see open_tiles.h; none where the journal was not there.
  /// throws:  io::Error(io_failure), here and below
  scheduler::Bytes mark_open(std::span<const render::Rect> tiles) const;

  /// Puts what earlier runs finished in its place.
  void restore(Mosaic& mosaic) const;

  /// Rays that earlier runs traced for what they finished.
  std::uint64_t resumed_rays() const;

  /// Takes down a tile that the mosaic has just accepted.
  void add(const render::Rect& tile, const render::RayCounts& rays, const Mosaic& mosaic);

  io::Journal& file() noexcept { return file_; }

 private:
  render::Rect area_;
  io::Journal file_;
};

}  // namespace tessera::app
