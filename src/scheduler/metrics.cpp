// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/metrics.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tessera::scheduler {
namespace {

// Graham's bound on the makespan of a list schedule.
double graham_bound_s(const RunRecord& run, double work_s) {
  double longest_s = 0;
  for (const TaskRecord& task : run.tasks) longest_s = std::max(longest_s, task.end_s - task.start_s);
  const auto ranks = static_cast<double>(run.ranks.size());
  return work_s / ranks + (1 - 1 / ranks) * longest_s;
}

// From the moment when the first rank ran out of work for good to the end.
double tail_s(const RunRecord& run) {
  std::vector<double> idle_since(run.ranks.size(), 0.0);
  for (const TaskRecord& task : run.tasks) {
    const double end_s = task.end_s + run.ranks[task.rank].clock_offset_s;
    idle_since[task.rank] = std::max(idle_since[task.rank], end_s);
  }
  double first_idle_s = run.makespan_s;
  for (const RankRecord& rank : run.ranks) {
    const bool only_served = rank.rank == kMasterRank && rank.tasks == 0;
    if (!only_served) first_idle_s = std::min(first_idle_s, idle_since[rank.rank]);
  }
  return run.makespan_s - first_idle_s;
}

// How many tasks a worker has changes by one: it is handed a task, or rank 0 has its result.
struct Change {
  double when_s;
  int by;
};

// For how long a worker had how many tasks.
struct Held {
  std::uint32_t most = 0;
  double any_s = 0;   ///< it had at least one
  double task_s = 0;  ///< the sum over its tasks of how long it had them
};

Held held_through(std::vector<Change>& changes) {
  // What comes back makes room for what is handed out at the same moment.
  std::sort(changes.begin(), changes.end(),
            [](const Change& a, const Change& b) { return a.when_s != b.when_s ? a.when_s < b.when_s : a.by < b.by; });
  Held held;
  std::int64_t now = 0;
  double since_s = 0;
  for (const Change& change : changes) {
    if (now > 0) held.any_s += change.when_s - since_s;
    held.task_s += static_cast<double>(now) * (change.when_s - since_s);
    since_s = change.when_s;
    now += change.by;
    held.most = std::max(held.most, static_cast<std::uint32_t>(std::max<std::int64_t>(now, 0)));
  }
  return held;
}

}  // namespace

Balance balance_of(const RunRecord& run) {
  Balance balance;
  balance.makespan_s = run.makespan_s;
  if (run.ranks.empty()) return balance;

  double work_s = 0;
  double most_s = 0;
  for (const RankRecord& rank : run.ranks) {
    work_s += rank.busy_s;
    most_s = std::max(most_s, rank.busy_s);
  }
  const auto ranks = static_cast<double>(run.ranks.size());
  const double mean_s = work_s / ranks;
  if (mean_s > 0) {
    balance.imbalance = most_s / mean_s - 1;
    balance.load_balance = mean_s / most_s;
  }
  if (run.makespan_s > 0) balance.efficiency = work_s / (ranks * run.makespan_s);
  balance.tail_s = tail_s(run);
  balance.graham_bound_s = graham_bound_s(run, work_s);
  return balance;
}

Overhead overhead_of(const RunRecord& run) {
  Overhead overhead;
  if (run.tasks.empty()) return overhead;
  const auto tasks = static_cast<double>(run.tasks.size());
  overhead.messages_per_task = static_cast<double>(run.messages.count) / tasks;
  overhead.bytes_per_task = static_cast<double>(run.messages.bytes) / tasks;

  std::vector<std::vector<Change>> changes(run.ranks.size());
  double master_s = 0;
  std::uint64_t travelled = 0;
  for (const TaskRecord& task : run.tasks) {
    if (task.rank == kMasterRank) continue;
    changes[task.rank].push_back({task.assigned_s, +1});
    changes[task.rank].push_back({task.received_s, -1});
    master_s += task.accepted_s - task.received_s;
    ++travelled;
  }
  if (travelled == 0) return overhead;
  overhead.master_s_per_task = master_s / static_cast<double>(travelled);
  double any_s = 0;
  double task_s = 0;
  for (std::vector<Change>& of_rank : changes) {
    const Held held = held_through(of_rank);
    overhead.most_held = std::max(overhead.most_held, held.most);
    any_s += held.any_s;
    task_s += held.task_s;
  }
  if (any_s > 0) overhead.mean_held = task_s / any_s;
  return overhead;
}

}  // namespace tessera::scheduler
