// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/faulty_cluster.h"

#include <cmath>
#include <iterator>
#include <utility>

#include "scheduler/all_policies.h"

namespace tessera::scheduler {
namespace {

constexpr double kSignEvery = 0.25;
constexpr double kLongestLife = 6;  // of a rank that dies, or before it stalls
constexpr std::uint64_t kMostEntries = 200'000;

std::uint64_t payload_of(std::uint32_t task) {
  return (task + 1) * 0x9e3779b97f4a7c15U;
}

}  // namespace

FaultyCluster::FaultyCluster(std::uint64_t seed, const Mishaps& mishaps)
    : random_(seed),
      mishaps_(mishaps),
      ranks_(1 + below(7)),
      plan_(random_plan()),
      task_duration_(std::exp(std::log(0.003) + unit() * std::log(200.0))),
      master_(plan_, ranks_),
      model_(plan_, ranks_),
      members_(ranks_),
      picture_(plan_.tasks) {}

Plan FaultyCluster::random_plan() {
  Plan plan;
  plan.policy = kAllPolicies[below(std::size(kAllPolicies))];
  plan.tasks = below(8) == 0 ? below(3) : below(60);
  if (below(3) == 0) plan.prefetch = 1 + below(20);
  if (below(3) == 0) {
    for (std::uint32_t task = 0; task < plan.tasks; ++task) plan.costs.push_back(below(5));
  }
  plan.ask_back = below(4) != 0;
  plan.lease_s = below(2) == 0 ? 1 : 2e-3;  // with the short one tasks are short enough for deep queues
  return plan;
}

Outcome FaultyCluster::play() {
  begin();
  while (!master_.is_over()) {
    promise(entries_ < kMostEntries, "every history ends");
    promise(!agenda_.empty(), "something always happens");
    const Entry entry = agenda_.top();
    agenda_.pop();
    now_ = entry.time;
    go_on(entry);
    look_after_own_seat();
  }
  Outcome outcome;
  for (std::uint32_t task = 0; task < plan_.tasks; ++task) {
    promise(picture_[task] == payload_of(task), "every task's own result is accepted");
  }
  for (Rank rank = 1; rank < ranks_; ++rank) {
    if (members_[rank].is_dead && !members_[rank].is_home) ++outcome.died;
    if (members_[rank].is_dead && !members_[rank].is_home && mishaps_.junk == 0) {
      promise(model_.is_given_up(rank), "who died is given up");
    }
  }
  outcome.faults = model_.faults();
  outcome.given_up = given_up_;
  return outcome;
}

void FaultyCluster::begin() {
  for (Rank rank = 1; rank < ranks_; ++rank) {
    Member& member = members_[rank];
    member.slowness = 0.3 + 2 * unit();
    member.is_mute = chance(mishaps_.mute);
    if (chance(mishaps_.dies)) schedule(unit() * kLongestLife * unit(), rank, Death{});
    if (chance(mishaps_.stalls)) {
      schedule(unit() * kLongestLife * unit(), rank, Stall{unit() * mishaps_.longest_stall});
    }
    for (const TaskRun& run : first_tasks(plan_, ranks_)[rank]) {
      for (std::uint32_t i = 0; i < run.count; ++i) member.queue.push_back(index_of(run.first) + i);
    }
    send_to_master(rank, {Hello{rank}});
    take_up_work(rank);
  }
  if (mishaps_.master_stalls) schedule(unit() * kLongestLife, kMasterRank, Stall{3 * unit()});
  for (std::uint32_t i = 0; i < mishaps_.junk; ++i) schedule(unit() * kLongestLife, kMasterRank, Junk{});
  schedule(0, kMasterRank, TickTime{});
  if (below(2) == 0) tell_master(TakeSeat{}, 0);
  look_after_own_seat();
}

void FaultyCluster::schedule(double time, Rank rank, Happening what) {
  agenda_.push({time, entries_++, rank, std::move(what)});
}

void FaultyCluster::go_on(const Entry& entry) {
  Member& member = members_[entry.rank];
  if (std::holds_alternative<Death>(entry.what)) member.is_dead = true;
  if (member.is_dead) return;
  if (now_ < member.away_until) return schedule(member.away_until, entry.rank, entry.what);

  if (const auto* message = std::get_if<ToMaster>(&entry.what)) {
    tell_master(message->event, message->payload);
  } else if (const auto* action = std::get_if<Action>(&entry.what)) {
    follow(entry.rank, *action);
  } else if (const auto* ends = std::get_if<TaskEnds>(&entry.what)) {
    if (ends->generation == member.generation && member.in_hand) finish_task(entry.rank);
  } else if (const auto* sign = std::get_if<Sign>(&entry.what)) {
    if (sign->generation != member.generation || !member.in_hand) return;
    send_to_master(entry.rank, {Alive{entry.rank}});
    schedule(now_ + kSignEvery, entry.rank, *sign);
  } else if (const auto* stall = std::get_if<Stall>(&entry.what)) {
    member.away_until = now_ + stall->duration;
  } else if (std::holds_alternative<TickTime>(entry.what)) {
    tell_master(Tick{}, 0);
    schedule(now_ + 0.01 + unit() * mishaps_.longest_tick, kMasterRank, TickTime{});
  } else if (std::holds_alternative<Junk>(entry.what)) {
    const Event event = random_event();
    const auto* result = std::get_if<Result>(&event);
    tell_master(event, result != nullptr ? payload_of(index_of(result->task)) : 0);
  }
}

void FaultyCluster::tell_master(const Event& event, std::uint64_t payload) {
  const double now_s = now_ * plan_.lease_s;
  const Verdict expected = model_.happen(event, now_s);
  actions_.clear();
  const Verdict verdict = master_.handle(event, now_s, actions_);
  promise(verdict == expected, "the verdict is what the model comes to");
  if (const auto* result = std::get_if<Result>(&event); result != nullptr && verdict == Verdict::accepted) {
    std::optional<std::uint64_t>& pixel = picture_[index_of(result->task)];
    promise(!pixel, "a task is accepted once");
    pixel = payload;
  }
  for (const Action& action : actions_) {
    model_.want(action);
    perform(action);
  }
  model_.compare_with(master_);
}

void FaultyCluster::perform(const Action& action) {
  if (const auto* assign = std::get_if<Assign>(&action)) {
    if (assign->rank == kMasterRank) return follow(kMasterRank, action);
    send_to_worker(assign->rank, action);
  } else if (const auto* ask = std::get_if<AskBack>(&action)) {
    send_to_worker(ask->rank, action);
  } else if (const auto* stop = std::get_if<Stop>(&action)) {
    send_to_worker(stop->rank, action);
  } else if (std::holds_alternative<GiveUp>(action)) {
    ++given_up_;
  }
}

// Rank 0 comes and goes as it likes, but does not go while there is nobody else.
void FaultyCluster::look_after_own_seat() {
  if (master_.is_done()) return;
  const bool may_change = below(16) == 0;
  if (!model_.is_seated() && (master_.is_deserted() || may_change)) {
    tell_master(TakeSeat{}, 0);
  } else if (model_.is_seated() && !master_.is_deserted() && may_change) {
    tell_master(LeaveSeat{}, 0);
  }
}

void FaultyCluster::send_to_master(Rank from, ToMaster message) {
  for (std::uint32_t copies = chance(mishaps_.doubles) ? 2 : 1; copies > 0; --copies) {
    if (chance(mishaps_.loses)) continue;
    schedule(arrival(members_[from].last_to_master), kMasterRank, message);
  }
}

void FaultyCluster::send_to_worker(Rank to, const Action& action) {
  for (std::uint32_t copies = chance(mishaps_.doubles) ? 2 : 1; copies > 0; --copies) {
    if (chance(mishaps_.loses)) continue;
    schedule(arrival(members_[to].last_from_master), to, action);
  }
}

// When a message that is sent now arrives.
double FaultyCluster::arrival(double& last) {
  double time = now_ + unit() * mishaps_.longest_delay;
  if (!mishaps_.reorders && time < last) time = last;
  last = time;
  return time;
}

// Does what the master says, as a worker, or as rank 0 for its own task.
void FaultyCluster::follow(Rank rank, const Action& action) {
  Member& member = members_[rank];
  if (member.is_home) return;
  if (const auto* assign = std::get_if<Assign>(&action)) {
    for (const TaskRun& run : assign->runs) {
      for (std::uint32_t i = 0; i < run.count; ++i) member.queue.push_back(index_of(run.first) + i);
    }
    take_up_work(rank);
  } else if (const auto* ask = std::get_if<AskBack>(&action)) {
    const std::uint32_t manner = mishaps_.answers_badly ? below(4) : 0;
    if (manner == 1) return;  // it will never answer
    RunList runs;
    if (manner == 2) runs.push(TaskRun{TaskId{below(plan_.tasks + 1)}, 1 + below(3)});
    if (manner != 2) runs = give_back(rank, ask->tasks);
    if (manner != 3) return send_to_master(rank, {Returned{rank, runs}});
    schedule(now_ + 3 * unit(), kMasterRank, ToMaster{Returned{rank, runs}});
  } else {
    member.is_home = true;
    member.in_hand.reset();
    send_to_master(rank, {Bye{rank}});
  }
}

void FaultyCluster::take_up_work(Rank rank) {
  Member& member = members_[rank];
  if (member.in_hand || member.queue.empty()) return;
  member.in_hand = member.queue.front();
  member.queue.pop_front();
  ++member.generation;
  const double duration = task_duration_ * member.slowness * (0.2 - std::log1p(-unit()));
  schedule(now_ + duration, rank, TaskEnds{member.generation});
  const bool gives_signs = rank != kMasterRank && !member.is_mute && duration > kSignEvery;
  if (gives_signs) schedule(now_ + kSignEvery, rank, Sign{member.generation});
}

void FaultyCluster::finish_task(Rank rank) {
  Member& member = members_[rank];
  const std::uint32_t task = *member.in_hand;
  member.in_hand.reset();
  const double busy_s = task_duration_ * plan_.lease_s;
  const Result result{rank, TaskId{task}, busy_s};
  if (rank == kMasterRank) {
    tell_master(result, payload_of(task));
  } else if (chance(mishaps_.damages)) {
    // Mostly the payload is broken, but it may be the number as well
    const std::uint32_t said = below(4) == 0 ? task ^ (1U << below(8)) : task;
    send_to_master(rank, {Damaged{rank, TaskId{said}}});
  } else {
    send_to_master(rank, {result, payload_of(task)});
  }
  take_up_work(rank);
}

RunList FaultyCluster::give_back(Rank rank, std::uint32_t most) {
  std::deque<std::uint32_t>& queue = members_[rank].queue;
  RunList runs;
  while (most > 0 && !queue.empty() && runs.push(TaskRun{TaskId{queue.back()}, 1})) {
    queue.pop_back();
    --most;
  }
  return runs;
}

Event FaultyCluster::random_event() {
  const Rank rank = below(ranks_ + 2);
  const TaskId task{below(plan_.tasks + 2)};
  switch (below(8)) {
    case 0:
      return Hello{rank};
    case 1:
      return Alive{rank};
    case 2:
      return Bye{rank};
    case 3:
      return Damaged{rank, task};
    case 4:
      return Tick{};
    case 5: {
      RunList runs;
      for (std::uint32_t count = below(4); count > 0; --count) {
        runs.push(TaskRun{TaskId{below(plan_.tasks + 1)}, 1 + below(4)});
      }
      return Returned{rank, runs};
    }
    default:
      return Result{rank, task, unit()};
  }
}

}  // namespace tessera::scheduler
