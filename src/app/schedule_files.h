// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "app/options.h"
#include "app/text_output.h"
#include "app/timeline.h"
#include "io/output_file.h"

namespace tessera::app {

/// The files that show how a render was shared out: the trace, and pictures of what tiles cost and of who rendered
/// them. None of them is there unless asked for.
class ScheduleFiles {
 public:
  /// Refuses names that cannot be written to, before anything else is done.
  /// throws:  UsageError
  static void check(const RenderOptions& options);

  /// throws:  io::Error(cannot_create)
  explicit ScheduleFiles(const RenderOptions& options);

  /// shapes:  the timeline's tiles cover `area`
  /// throws:  io::Error(io_failure)
  void write(const Timeline& timeline, const render::Rect& area);

  /// Gives the files their names.
  /// throws:  io::Error(io_failure)
  void commit();

 private:
  std::optional<TextOutput> trace_;
  std::optional<io::OutputFile> cost_map_;
  std::optional<io::OutputFile> owner_map_;
};

}  // namespace tessera::app
