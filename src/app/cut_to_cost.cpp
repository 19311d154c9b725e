// SPDX-License-Identifier: BSD-3-Clause
#include "app/cut_to_cost.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scheduler/grain.h"

namespace tessera::app {
namespace {

/// The side of the largest tile. At the mean cost of a pixel it takes 1/16 of a rank's share, or twice what is worth a
/// task.
std::uint32_t longest_side(const render::Rect& area, double work_s, std::uint32_t ranks) {
  const double share = std::max(1 / (16.0 * ranks), 2 * scheduler::least_task_s(work_s, ranks) / work_s);
  const double pixels = std::min(share, 1.0) * static_cast<double>(area.pixels());
  return std::bit_floor(std::max(1U, static_cast<std::uint32_t>(std::sqrt(pixels))));
}

}  // namespace

std::vector<render::CostedTile> cut_to_cost(const render::Rect& area,
                                            const std::function<double(const render::Rect&)>& seconds_of,
                                            std::uint32_t ranks) {
  const double work_s = seconds_of(area);
  return render::cut_by_cost(area, longest_side(area, work_s, ranks), seconds_of,
                             [&](double left_s) { return scheduler::largest_task_s(left_s, work_s, ranks); });
}

}  // namespace tessera::app
