// SPDX-License-Identifier: BSD-3-Clause
#include "app/schedule_files.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/exit_code.h"
#include "io/image_file.h"
#include "io/tile_map.h"

namespace tessera::app {
namespace {

void require_png(const char* option, const std::optional<std::filesystem::path>& path) {
  if (!path || io::image_format_of(*path) == io::ImageFormat::png) return;
  throw UsageError(std::string(option) + ": \"" + path->string() + "\" must end in .png (it becomes a picture)");
}

std::string cost_map_of(const Timeline& timeline, const render::Rect& area) {
  std::vector<double> seconds;
  for (const scheduler::TaskRecord& task : timeline.run.tasks) seconds.push_back(task.end_s - task.start_s);
  return io::encode_cost_map(area, timeline.tiles, seconds);
}

std::string owner_map_of(const Timeline& timeline, const render::Rect& area) {
  std::vector<std::uint32_t> ranks;
  for (const scheduler::TaskRecord& task : timeline.run.tasks) ranks.push_back(task.rank);
  return io::encode_owner_map(area, timeline.tiles, ranks, static_cast<std::uint32_t>(timeline.run.ranks.size()));
}

}  // namespace

void ScheduleFiles::check(const RenderOptions& options) {
  require_png("--cost-map", options.cost_map);
  require_png("--owner-map", options.owner_map);
}

ScheduleFiles::ScheduleFiles(const RenderOptions& options) {
  if (options.trace) trace_.emplace(*options.trace);
  if (options.cost_map) cost_map_.emplace(*options.cost_map);
  if (options.owner_map) owner_map_.emplace(*options.owner_map);
}

void ScheduleFiles::write(const Timeline& timeline, const render::Rect& area) {
  if (trace_) write_timeline(timeline, [this](std::string_view text) { trace_->write(text); });
  if (cost_map_) cost_map_->write(cost_map_of(timeline, area));
  if (owner_map_) owner_map_->write(owner_map_of(timeline, area));
}

void ScheduleFiles::commit() {
  if (trace_) trace_->commit();
  if (cost_map_) cost_map_->commit();
  if (owner_map_) owner_map_->commit();
}

}  // namespace tessera::app
