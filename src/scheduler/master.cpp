// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/master.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace tessera::scheduler {
namespace {

// The mean over a rank's tasks forgets: neighbouring tasks are alike, far ones are not.
constexpr std::uint32_t kRecentTasks = 16;

// A rank that has delivered this many broken results gets no more tasks.
constexpr std::uint32_t kMostBroken = 3;

// Work that a rank has begun before the question reaches it cannot be given back: a worker looks at its mail between
// slices of 0.1 ms.
constexpr double kWorthAskingSeconds = 1e-4;

const Plan& checked(const Plan& plan, std::uint32_t ranks) {
  require_feasible(plan, ranks);
  return plan;
}

bool lies_in(TaskId task, const TaskRun& run) noexcept {
  return index_of(task) - index_of(run.first) < run.count;
}

RunList take_first(const Plan& plan, std::uint32_t ranks, Rank rank, TaskQueue& queue) {
  Standing standing;
  standing.rank = rank;
  standing.ranks = ranks;
  standing.backlog = queue.backlog(rank);
  standing.prefetch = plan.prefetch;
  return queue.take(rank, share_to_assign(plan.policy, standing));
}

}  // namespace

std::vector<RunList> first_tasks(const Plan& plan, std::uint32_t ranks) {
  TaskQueue queue(plan, ranks);
  std::vector<RunList> first(ranks);
  for (Rank rank = 1; rank < ranks; ++rank) first[rank] = take_first(plan, ranks, rank, queue);
  return first;
}

Master::Master(const Plan& plan, std::uint32_t ranks)
    : plan_(checked(plan, ranks)),
      queue_(plan_, ranks),
      ledger_(plan_.tasks, ranks),
      seats_(ranks),
      workers_there_(ranks - 1),
      workers_present_(ranks - 1) {
  for (Rank rank = 1; rank < ranks; ++rank) {
    seats_[rank].presence = Presence::present;
    for (const TaskRun& run : take_first(plan_, ranks, rank, queue_)) ledger_.assign(run, rank);
    if (held_by(rank) > 0) continue;
    seats_[rank].idle = true;
    idle_.push_back(rank);
  }
}

Verdict Master::handle(const Event& event, double now_s, std::vector<Action>& out) {
  const double passed_s = now_s - now_s_;
  now_s_ = now_s;
  // Where rank 0 itself was stopped, it cannot know whether the others were silent.
  if (passed_s > plan_.lease_s) {
    for (Seat& seat : seats_) seat.heard_s += passed_s;
  }
  return std::visit([&](const auto& happened) { return on(happened, out); }, event);
}

Verdict Master::on(const Hello& hello, std::vector<Action>& out) {
  if (!is_worker(hello.rank)) return Verdict::unknown;
  if (seats_[hello.rank].greeted) return Verdict::duplicate;
  seats_[hello.rank].greeted = true;
  hear(hello.rank, out);
  return Verdict::accepted;
}

Verdict Master::on(const TakeSeat&, std::vector<Action>& out) {
  Seat& own = seats_[kMasterRank];
  if (own.presence != Presence::away) return Verdict::duplicate;
  own.presence = Presence::present;
  refill(kMasterRank, out);
  return Verdict::accepted;
}

Verdict Master::on(const LeaveSeat&, std::vector<Action>&) {
  Seat& own = seats_[kMasterRank];
  if (own.presence != Presence::present) return Verdict::duplicate;
  own.presence = Presence::away;
  return Verdict::accepted;
}

Verdict Master::on(const Result& result, std::vector<Action>& out) {
  if (result.rank >= seats_.size() || !is_task(result.task)) return Verdict::unknown;
  hear(result.rank, out);
  const Delivery delivery = ledger_.deliver(result.rank, result.task);
  Seat& seat = seats_[result.rank];
  if (delivery == Delivery::not_held && seat.broken > 0) {
    ++faults_.late;
    refill(result.rank, out);
    return Verdict::late;
  }
  if (delivery == Delivery::not_held) {
    return ledger_.is_done(result.task) ? Verdict::duplicate : Verdict::unassigned;
  }
  seat.way_s = std::min(seat.way_s, std::max(0.0, now_s_ - result.start_s - result.busy_s));
  ++seat.delivered;
  seat.mean_task_s += (result.busy_s - seat.mean_task_s) / std::min(seat.delivered, kRecentTasks);

  const bool is_late = delivery == Delivery::late;
  if (is_late) ++faults_.late;
  if (!is_late && faults_.reissued > 0) queue_.withdraw(result.task);
  // A result is also the request for more.
  if (!is_late && is_done()) {
    finish(out);
  } else {
    refill(result.rank, out);
  }
  return is_late ? Verdict::late : Verdict::accepted;
}

Verdict Master::on(const Returned& returned, std::vector<Action>& out) {
  if (!is_worker(returned.rank)) return Verdict::unknown;
  hear(returned.rank, out);
  Seat& seat = seats_[returned.rank];
  // Nothing of it counts where a part of it is wrong.
  for (const TaskRun* run = returned.runs.begin(); run != returned.runs.end(); ++run) {
    for (std::uint32_t i = 0; i < run->count; ++i) {
      const TaskId task{index_of(run->first) + i};
      if (!is_task(task)) return Verdict::unknown;
      const auto before = std::count_if(returned.runs.begin(), run, [&](const TaskRun& r) { return lies_in(task, r); });
      if (seat.broken == 0 && ledger_.times_held(returned.rank, task) <= before) return Verdict::unassigned;
    }
  }
  seat.asked = false;
  for (const TaskRun& run : returned.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const TaskId task{index_of(run.first) + i};
      if (!ledger_.has(returned.rank, task)) continue;
      give_up_task(returned.rank, task);
      ++faults_.returned;
    }
  }
  feed_idle(out);
  if (held_by(returned.rank) == 0) refill(returned.rank, out);
  return Verdict::accepted;
}

Verdict Master::on(const Damaged& damaged, std::vector<Action>& out) {
  if (!is_worker(damaged.rank)) return Verdict::unknown;
  hear(damaged.rank, out);
  ++faults_.damaged;
  // What is not with the rank is a number as broken as the rest: the task itself runs into its lease.
  if (is_task(damaged.task) && ledger_.has(damaged.rank, damaged.task)) {
    if (give_up_task(damaged.rank, damaged.task)) ++faults_.reissued;
  }
  Seat& seat = seats_[damaged.rank];
  if (++seat.broken == kMostBroken && seat.presence == Presence::present) fall_silent(damaged.rank);
  feed_idle(out);
  refill(damaged.rank, out);
  return Verdict::accepted;
}

Verdict Master::on(const Alive& alive, std::vector<Action>& out) {
  if (!is_worker(alive.rank)) return Verdict::unknown;
  hear(alive.rank, out);
  return Verdict::accepted;
}

Verdict Master::on(const Bye& bye, std::vector<Action>&) {
  if (!is_worker(bye.rank)) return Verdict::unknown;
  Seat& seat = seats_[bye.rank];
  if (seat.presence == Presence::gone) return Verdict::duplicate;
  if (seat.presence == Presence::given_up) {
    seat.presence = Presence::gone;
    return Verdict::late;
  }
  if (seat.presence != Presence::leaving) return Verdict::unassigned;
  seat.presence = Presence::gone;
  --workers_there_;
  return Verdict::accepted;
}

Verdict Master::on(const Tick&, std::vector<Action>& out) {
  for (Rank rank = 1; rank < seats_.size(); ++rank) {
    Seat& seat = seats_[rank];
    if (is_done() && seat.presence == Presence::present) stop(rank, out);
    if (!is_overdue(seat)) continue;
    if (seat.presence == Presence::leaving) {
      seat.presence = Presence::given_up;
      --workers_there_;
      out.push_back(GiveUp{rank});
    } else if (seat.presence == Presence::present && held_by(rank) > 0) {
      ++faults_.silences;
      fall_silent(rank);
    }
  }
  feed_idle(out);
  return Verdict::accepted;
}

// Whoever is heard of is there.
void Master::hear(Rank rank, std::vector<Action>& out) {
  Seat& seat = seats_[rank];
  seat.heard_s = now_s_;
  if (is_done() && seat.presence == Presence::present) stop(rank, out);
  if (seat.presence != Presence::silent || seat.broken >= kMostBroken) return;
  seat.presence = Presence::present;
  ++workers_present_;

  // What nobody else has yet, it still does; what others have, it need not begin.
  const std::uint32_t held = held_by(rank);
  const auto reclaimed = ledger_.reclaim(rank);
  for (const TaskId task : reclaimed) queue_.withdraw(task);
  if (held > reclaimed.size() && !seat.asked) {
    seat.asked = true;
    out.push_back(AskBack{rank, held});
  }
}

void Master::fall_silent(Rank rank) {
  seats_[rank].presence = Presence::silent;
  --workers_present_;
  for (const TaskId task : ledger_.reopen_held_by(rank)) {
    queue_.put_back(task);
    ++faults_.reissued;
  }
  queue_.disown(rank);
}

bool Master::give_up_task(Rank rank, TaskId task) {
  const bool is_open = ledger_.give_up(rank, task);
  if (is_open) queue_.put_back(task);
  return is_open;
}

RunList Master::take(Rank rank) {
  const Seat& seat = seats_[rank];
  const Standing standing{
      .rank = rank,
      .ranks = static_cast<std::uint32_t>(seats_.size()),
      .backlog = queue_.backlog(rank),
      .held = held_by(rank),
      .round_trip_s = seat.delivered > 0 ? std::optional(2 * seat.way_s) : std::nullopt,
      .mean_task_s = seat.delivered > 0 ? std::optional(seat.mean_task_s) : std::nullopt,
      .prefetch = plan_.prefetch,
  };
  return queue_.take(rank, share_to_assign(plan_.policy, standing));
}

void Master::refill(Rank rank, std::vector<Action>& out) {
  Seat& seat = seats_[rank];
  if (seat.presence != Presence::present || is_done()) return;
  const bool had_none = held_by(rank) == 0;
  const RunList runs = take(rank);
  if (runs.empty()) {
    if (had_none) rest(rank, out);
    return;
  }
  if (had_none) seat.heard_s = now_s_;
  for (const TaskRun& run : runs) ledger_.assign(run, rank);
  out.push_back(Assign{rank, runs});
}

// There is nothing to give to a rank: perhaps another one has more than it can begin soon.
void Master::rest(Rank rank, std::vector<Action>& out) {
  if (!seats_[rank].idle) {
    seats_[rank].idle = true;
    idle_.push_back(rank);
  }
  if (plan_.policy == Policy::dynamic && plan_.ask_back) ask_back(out);
}

void Master::feed_idle(std::vector<Action>& out) {
  while (!idle_.empty() && queue_.has_returned()) {
    const Rank rank = idle_.back();
    idle_.pop_back();
    seats_[rank].idle = false;
    if (held_by(rank) == 0) refill(rank, out);
  }
}

void Master::ask_back(std::vector<Action>& out) {
  Rank busiest = kMasterRank;
  double most_s = kWorthAskingSeconds;
  for (Rank rank = 1; rank < seats_.size(); ++rank) {
    const Seat& seat = seats_[rank];
    if (seat.presence != Presence::present || seat.asked || held_by(rank) < 2) continue;
    // Of a rank that has not delivered yet nothing is known: its first task may be long.
    const double mean_s = seat.delivered > 0 ? seat.mean_task_s : std::numeric_limits<double>::infinity();
    const double waiting_s = (held_by(rank) - 1) * mean_s;
    if (waiting_s <= most_s) continue;
    busiest = rank;
    most_s = waiting_s;
  }
  if (busiest == kMasterRank) return;
  seats_[busiest].asked = true;
  out.push_back(AskBack{busiest, held_by(busiest) / 2});
}

void Master::stop(Rank rank, std::vector<Action>& out) {
  Seat& seat = seats_[rank];
  if (seat.presence == Presence::present) --workers_present_;
  // A worker has a lease from here on to say goodbye, but one that was not heard of for a lease has used its own up.
  if (seat.presence == Presence::present || seat.broken >= kMostBroken) seat.heard_s = now_s_;
  seat.presence = Presence::leaving;
  out.push_back(Stop{rank});
}

void Master::finish(std::vector<Action>& out) {
  for (Rank rank = 1; rank < seats_.size(); ++rank) stop(rank, out);
  seats_[kMasterRank].presence = Presence::gone;
  out.push_back(Done{});
}

}  // namespace tessera::scheduler
