// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/ledger.h"

#include <algorithm>

namespace tessera::scheduler {

Ledger::Ledger(std::uint32_t tasks, std::uint32_t ranks) : holder_(tasks, kNobody), held_(ranks) {}

void Ledger::assign(const TaskRun& run, Rank rank) {
  std::fill_n(holder_.begin() + index_of(run.first), run.count, rank);
  held_[rank] += run.count;
}

Delivery Ledger::deliver(Rank rank, TaskId task) {
  const std::uint32_t index = index_of(task);
  if (holder_[index] != rank) {
    const auto copy = copy_of(index, rank);
    if (copy == copies_.end()) return Delivery::not_held;
    copies_.erase(copy);
  }
  --held_[rank];
  if (holder_[index] == kDone) return Delivery::late;

  // Whoever works on it now does so in vain.
  if (holder_[index] != rank && holder_[index] != kNobody) copies_.emplace(index, holder_[index]);
  holder_[index] = kDone;
  ++done_;
  return Delivery::accepted;
}

bool Ledger::give_up(Rank rank, TaskId task) {
  const std::uint32_t index = index_of(task);
  --held_[rank];
  if (holder_[index] == rank) {
    holder_[index] = kNobody;
    return true;
  }
  copies_.erase(copy_of(index, rank));
  return false;
}

std::uint32_t Ledger::times_held(Rank rank, TaskId task) const {
  const std::uint32_t index = index_of(task);
  const auto [begin, end] = copies_.equal_range(index);
  const auto copies = std::count_if(begin, end, [&](const auto& copy) { return copy.second == rank; });
  return static_cast<std::uint32_t>(copies) + (holder_[index] == rank ? 1 : 0);
}

std::vector<TaskId> Ledger::reopen_held_by(Rank rank) {
  std::vector<TaskId> opened;
  for (std::uint32_t index = 0; index < holder_.size(); ++index) {
    if (holder_[index] != rank) continue;
    holder_[index] = kNobody;
    copies_.emplace(index, rank);
    opened.push_back(TaskId{index});
  }
  return opened;
}

std::vector<TaskId> Ledger::reclaim(Rank rank) {
  std::vector<TaskId> reclaimed;
  for (auto copy = copies_.begin(); copy != copies_.end();) {
    const auto [index, owner] = *copy;
    if (owner != rank || holder_[index] != kNobody) {
      ++copy;
      continue;
    }
    holder_[index] = rank;
    reclaimed.push_back(TaskId{index});
    copy = copies_.erase(copy);
  }
  return reclaimed;
}

Ledger::Copies::const_iterator Ledger::copy_of(std::uint32_t task, Rank rank) const {
  const auto [begin, end] = copies_.equal_range(task);
  const auto found = std::find_if(begin, end, [&](const auto& copy) { return copy.second == rank; });
  return found == end ? copies_.end() : found;
}

}  // namespace tessera::scheduler
