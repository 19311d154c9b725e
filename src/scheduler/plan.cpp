// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "scheduler/grain.h"

namespace tessera::scheduler {
namespace {

constexpr std::array<std::pair<MasterRole, std::string_view>, 3> kNames{{
    {MasterRole::automatic, "auto"},
    {MasterRole::dedicated, "dedicated"},
    {MasterRole::rendering, "rendering"},
}};

constexpr std::uint32_t kRanksThatAllRender = 4;
constexpr double kLeastWorkRatio = 100;
constexpr double kMostDuty = 0.5;

}  // namespace

std::optional<MasterRole> parse_master_role(std::string_view name) noexcept {
  const auto* found =
      std::find_if(kNames.begin(), kNames.end(), [&](const auto& entry) { return entry.second == name; });
  if (found == kNames.end()) return std::nullopt;
  return found->first;
}

std::string_view name_of(MasterRole role) noexcept {
  return std::find_if(kNames.begin(), kNames.end(), [&](const auto& entry) { return entry.first == role; })->second;
}

void require_feasible(const Plan& plan, std::uint32_t ranks) {
  if (ranks == 0) throw std::invalid_argument("a plan needs ranks (there are none)");
  if (plan.role == MasterRole::dedicated && ranks == 1) {
    throw std::invalid_argument("a dedicated master needs workers (there is one rank) use the role auto");
  }
  if (plan.role == MasterRole::dedicated && has_owners(plan.policy)) {
    throw std::invalid_argument("a dedicated master cannot be had with the policy " +
                                std::string(name_of(plan.policy)) + " (rank 0 owns tasks) use the role auto");
  }
  if (plan.prefetch && *plan.prefetch == 0) {
    throw std::invalid_argument("prefetch must be >= 1 (a worker that holds no task renders none)");
  }
  if (!(plan.lease_s > 0)) throw std::invalid_argument("a lease must be > 0 seconds (or nobody could keep it)");
  if (!plan.costs.empty() && plan.costs.size() != plan.tasks) {
    throw std::invalid_argument("there must be one cost per task (" + std::to_string(plan.costs.size()) + " costs, " +
                                std::to_string(plan.tasks) + " tasks)");
  }
  if (std::any_of(plan.costs.begin(), plan.costs.end(), [](double cost) { return !std::isfinite(cost) || cost < 0; })) {
    throw std::invalid_argument("a cost must be finite and >= 0");
  }
}

bool should_render(const Plan& plan, const Workload& load) noexcept {
  if (plan.role != MasterRole::automatic) return plan.role == MasterRole::rendering;
  if (has_owners(plan.policy) || load.ranks <= kRanksThatAllRender) return true;
  if (!load.mean_task_s) return false;
  const double duty = (load.ranks - 1) * kMasterSecondsPerTask / *load.mean_task_s;
  return work_ratio(load.tasks * *load.mean_task_s, load.ranks) > kLeastWorkRatio && duty < kMostDuty;
}

MasterRole settled_role(const Plan& plan, std::uint32_t ranks) noexcept {
  if (plan.costs.empty() || plan.role != MasterRole::automatic) return plan.role;
  const double work_s = std::accumulate(plan.costs.begin(), plan.costs.end(), 0.0);
  const bool renders = should_render(plan, {ranks, plan.tasks, work_s / plan.tasks});
  return renders ? MasterRole::rendering : MasterRole::dedicated;
}

}  // namespace tessera::scheduler
