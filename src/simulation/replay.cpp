// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/replay.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace tessera::simulation {
namespace {

using Label = std::array<std::byte, sizeof(std::uint32_t)>;

Label label_of(scheduler::TaskId task) noexcept {
  Label label;
  const std::uint32_t index = index_of(task);
  std::memcpy(label.data(), &index, sizeof index);
  return label;
}

}  // namespace

scheduler::Work replay(std::span<const CostMap::Cost> costs, double slice_s, Spend spend) {
  if (!(slice_s > 0)) throw std::invalid_argument("a slice must take some time");
  return [=, spend = std::move(spend)](scheduler::TaskId task, const std::function<void()>& between_slices) {
    const CostMap::Cost& cost = costs[index_of(task)];
    for (double left_s = cost.seconds; left_s > 0; left_s -= slice_s) {
      spend(std::min(slice_s, left_s));
      between_slices();
    }
    scheduler::Bytes delivered(cost.bytes);
    const Label label = label_of(task);
    std::copy_n(label.begin(), std::min(label.size(), delivered.size()), delivered.begin());
    return delivered;
  };
}

void Collection::accept(scheduler::TaskId task, std::span<const std::byte> delivered) {
  const std::size_t expected = costs_[index_of(task)].bytes;
  const Label label = label_of(task);
  const std::size_t compared = std::min(label.size(), expected);
  if (delivered.size() != expected || !std::equal(label.begin(), label.begin() + compared, delivered.begin())) {
    throw std::runtime_error("the result of task " + std::to_string(index_of(task)) + " is not its own");
  }
  ++times_[index_of(task)];
}

bool Collection::is_complete() const noexcept {
  return std::all_of(times_.begin(), times_.end(), [](std::uint32_t times) { return times == 1; });
}

}  // namespace tessera::simulation
