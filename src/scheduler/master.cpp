// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/master.h"

#include <algorithm>
#include <limits>

namespace tessera::scheduler {
namespace {

// No ranks, but marks in the place of one.
constexpr Rank kNobody = std::numeric_limits<Rank>::max();
constexpr Rank kAccepted = kNobody - 1;

// The mean over a rank's tasks forgets: neighbouring tasks are alike, far ones are not.
constexpr std::uint32_t kRecentTasks = 16;

const Plan& checked(const Plan& plan, std::uint32_t ranks) {
  require_feasible(plan, ranks);
  return plan;
}

}  // namespace

Master::Master(const Plan& plan, std::uint32_t ranks)
    : policy_(plan.policy),
      prefetch_(plan.prefetch),
      queue_(checked(plan, ranks), ranks),
      seats_(ranks),
      holder_(plan.tasks, kNobody) {}

Verdict Master::handle(const Event& event, std::vector<Action>& out) {
  return std::visit([&](const auto& happened) { return on(happened, out); }, event);
}

Verdict Master::on(const Hello& hello, std::vector<Action>& out) {
  if (hello.rank >= seats_.size()) return Verdict::unknown;
  Seat& seat = seats_[hello.rank];
  if (seat.presence != Presence::absent) return Verdict::duplicate;
  seat.presence = Presence::present;
  if (is_done()) {
    stop(hello.rank, out);
  } else {
    refill(hello.rank, out);
  }
  return Verdict::accepted;
}

Verdict Master::on(const Leave& leave, std::vector<Action>&) {
  if (leave.rank >= seats_.size()) return Verdict::unknown;
  Seat& seat = seats_[leave.rank];
  if (seat.presence != Presence::present) return Verdict::duplicate;
  seat.presence = Presence::absent;
  return Verdict::accepted;
}

Verdict Master::on(const Result& result, std::vector<Action>& out) {
  const std::uint32_t task = index_of(result.task);
  if (result.rank >= seats_.size() || task >= holder_.size()) return Verdict::unknown;
  if (holder_[task] == kAccepted) return Verdict::duplicate;
  if (holder_[task] != result.rank) return Verdict::unassigned;

  // Accept.
  holder_[task] = kAccepted;
  ++accepted_;
  Seat& seat = seats_[result.rank];
  --seat.held;
  ++seat.delivered;
  seat.mean_task_s += (result.busy_s - seat.mean_task_s) / std::min(seat.delivered, kRecentTasks);

  // A result is also the request for more.
  if (is_done()) {
    finish(out);
  } else if (seat.presence == Presence::present) {
    refill(result.rank, out);
  }
  return Verdict::accepted;
}

void Master::refill(Rank rank, std::vector<Action>& out) {
  Seat& seat = seats_[rank];
  const Standing standing{
      .rank = rank,
      .ranks = static_cast<std::uint32_t>(seats_.size()),
      .remaining = queue_.remaining(rank),
      .held = seat.held,
      .mean_task_s = seat.delivered > 0 ? std::optional(seat.mean_task_s) : std::nullopt,
      .prefetch = prefetch_,
  };
  const RunList runs = queue_.take(rank, tasks_to_assign(policy_, standing));
  if (runs.empty()) return;
  for (const TaskRun& run : runs) {
    std::fill_n(holder_.begin() + index_of(run.first), run.count, rank);
    seat.held += run.count;
  }
  out.push_back(Assign{rank, runs});
}

void Master::stop(Rank rank, std::vector<Action>& out) {
  seats_[rank].presence = Presence::stopped;
  if (rank != kMasterRank) out.push_back(Stop{rank});
}

void Master::finish(std::vector<Action>& out) {
  for (Rank rank = 0; rank < seats_.size(); ++rank) {
    if (seats_[rank].presence == Presence::present) stop(rank, out);
  }
  out.push_back(Done{});
}

}  // namespace tessera::scheduler
