// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "scheduler/policy.h"

// What is to be done and how it is shared out: all that a schedule depends on besides time.
namespace tessera::scheduler {

/// What rank 0 does besides handing out tasks.
enum class MasterRole : std::uint8_t {
  automatic,  ///< renders while that pays, see should_render
  dedicated,  ///< never renders
  rendering,  ///< always renders
};

/// The role with this name ("auto", "dedicated", "rendering"), or nullopt.
std::optional<MasterRole> parse_master_role(std::string_view name) noexcept;
std::string_view name_of(MasterRole role) noexcept;

/// shapes:  costs is empty or holds one value per task
/// units:   costs: seconds
struct Plan {
  Policy policy = Policy::dynamic;
  std::uint32_t tasks = 0;
  std::vector<double> costs;  ///< predicted; where given, dynamic and self hand out the dearest task first
  MasterRole role = MasterRole::automatic;
  std::optional<unsigned> prefetch;  ///< tasks that a worker shall hold, instead of what the policy finds right
  bool ask_back = true;              ///< dynamic: whether idle ranks get tasks that others hold and have not begun
  double lease_s = 1;                ///< a worker that holds tasks and is silent for longer loses them; may be infinite
};

/// Refuses a plan that `ranks` ranks cannot carry out.
/// throws:  std::invalid_argument "<problem> (<why>) <suggestion>"
void require_feasible(const Plan& plan, std::uint32_t ranks);

/// How the work looks from rank 0.
/// units:   seconds
struct Workload {
  std::uint32_t ranks = 1;
  std::uint32_t tasks = 0;
  std::optional<double> mean_task_s;  ///< over all results so far
};

/// Whether rank 0 should take a task of its own now. In the role `automatic` it does
///   - with owned tasks, for nobody else may do its share;
///   - on up to 4 ranks, for a rank that does not render costs a quarter of the machine or more;
///   - beyond, from the first result on, while x = W / (P^2 o) > 100 and its duty (P - 1) o / t < 0.5,
/// with W the work in all tasks, t their mean, P the ranks and o = 3 us rank 0's time per task.
bool should_render(const Plan& plan, const Workload& load) noexcept;

/// The plan's role or, where that is `automatic` and costs are predicted, what should_render makes of them: then rank 0
/// need not wait for the first results to know.
MasterRole settled_role(const Plan& plan, std::uint32_t ranks) noexcept;

}  // namespace tessera::scheduler
