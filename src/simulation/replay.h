// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scheduler/work.h"
#include "simulation/cost_map.h"

// Work that only takes its time: what ranks of a simulation do instead of rendering.
namespace tessera::simulation {

/// Lets simulated time pass on the calling rank, in seconds.
using Spend = std::function<void(double)>;

/// Spends what each task costs, in slices of `slice_s` with a look at the messages after each, and returns as many
/// bytes as the task delivers, which say which task it was.
/// shapes:  one cost per task; `costs` must outlive the work; slice_s > 0
scheduler::Work replay(std::span<const CostMap::Cost> costs, double slice_s, Spend spend);

/// Checks on rank 0 that each result is of its task, of its size, and comes once.
class Collection {
 public:
  explicit Collection(std::span<const CostMap::Cost> costs) : costs_(costs), times_(costs.size()) {}

  /// throws:  std::runtime_error where a result is not what the task delivers
  void accept(scheduler::TaskId task, std::span<const std::byte> delivered);

  /// Whether every task has come exactly once.
  bool is_complete() const noexcept;

 private:
  std::span<const CostMap::Cost> costs_;
  std::vector<std::uint32_t> times_;  ///< that each task has come
};

}  // namespace tessera::simulation
