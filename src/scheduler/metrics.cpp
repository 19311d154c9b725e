// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/metrics.h"

#include <algorithm>
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
  for (const TaskRecord& task : run.tasks) idle_since[task.rank] = std::max(idle_since[task.rank], task.end_s);
  double first_idle_s = run.makespan_s;
  for (const RankRecord& rank : run.ranks) {
    const bool only_served = rank.rank == kMasterRank && rank.tasks == 0;
    if (!only_served) first_idle_s = std::min(first_idle_s, idle_since[rank.rank]);
  }
  return run.makespan_s - first_idle_s;
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

}  // namespace tessera::scheduler
