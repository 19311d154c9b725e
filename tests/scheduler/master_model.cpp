// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/master_model.h"

#include <algorithm>

namespace tessera::scheduler {
namespace {

constexpr std::uint32_t kMostBroken = 3;

template <class Visit>
void for_each_task(const RunList& runs, const Visit& visit) {
  for (const TaskRun& run : runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) visit(index_of(run.first) + i);
  }
}

}  // namespace

MasterModel::MasterModel(const Plan& plan, std::uint32_t ranks) : plan_(plan), members_(ranks), tasks_(plan.tasks) {
  untouched_.resize(has_owners(plan.policy) ? ranks : 1);
  for (std::uint32_t task = 0; task < plan.tasks; ++task) ++untouched_[task % untouched_.size()];
  for (Rank rank = 1; rank < ranks; ++rank) members_[rank].where = Where::present;
  for (Rank rank = 1; rank < ranks; ++rank) {
    for_each_task(first_tasks(plan, ranks)[rank], [&](std::uint32_t task) { hand_out(task, rank); });
  }
}

Verdict MasterModel::happen(const Event& event, double now_s) {
  const double passed_s = now_s - now_s_;
  now_s_ = now_s;
  is_heard_ = false;
  answering_.reset();
  if (passed_s > plan_.lease_s) {
    for (Member& member : members_) member.heard_s += passed_s;
  }
  return std::visit([&](const auto& happened) { return on(happened); }, event);
}

Verdict MasterModel::on(const Hello& hello) {
  if (!is_worker(hello.rank)) return Verdict::unknown;
  if (members_[hello.rank].greeted) return Verdict::duplicate;
  members_[hello.rank].greeted = true;
  hear(hello.rank);
  return Verdict::accepted;
}

Verdict MasterModel::on(const TakeSeat&) {
  is_heard_ = members_[kMasterRank].where == Where::away;
  if (!is_heard_) return Verdict::duplicate;
  members_[kMasterRank].where = Where::present;
  return Verdict::accepted;
}

Verdict MasterModel::on(const LeaveSeat&) {
  if (members_[kMasterRank].where != Where::present) return Verdict::duplicate;
  members_[kMasterRank].where = Where::away;
  return Verdict::accepted;
}

Verdict MasterModel::on(const Result& result) {
  const std::uint32_t index = index_of(result.task);
  if (result.rank >= members_.size() || index >= tasks_.size()) return Verdict::unknown;
  hear(result.rank);
  Task& task = tasks_[index];
  const bool was_held = task.holder.has_value();
  const bool had = lose(result.rank, index);
  if (!had && members_[result.rank].broken == 0) return task.accepted ? Verdict::duplicate : Verdict::unassigned;
  if (!had || task.accepted) {
    ++faults_.late;
    return Verdict::late;
  }
  task.accepted = true;
  task.holder.reset();
  if (!was_held) --open_again_;
  ++accepted_;
  return Verdict::accepted;
}

Verdict MasterModel::on(const Returned& returned) {
  if (!is_worker(returned.rank)) return Verdict::unknown;
  hear(returned.rank);
  // Take them out of a copy first: where one is wrong, nothing has happened
  Member& member = members_[returned.rank];
  std::vector<std::uint32_t> left = member.has;
  std::vector<std::uint32_t> given;
  for (const TaskRun& run : returned.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const std::uint32_t task = index_of(run.first) + i;
      if (task >= tasks_.size()) return Verdict::unknown;
      const auto found = std::find(left.begin(), left.end(), task);
      if (found == left.end() && member.broken == 0) return Verdict::unassigned;
      if (found == left.end()) continue;
      left.erase(found);
      given.push_back(task);
    }
  }
  member.asked = false;
  answering_ = returned.rank;
  for (const std::uint32_t task : given) {
    lose(returned.rank, task);
    if (tasks_[task].holder == returned.rank) release(task);
    ++faults_.returned;
  }
  return Verdict::accepted;
}

Verdict MasterModel::on(const Damaged& damaged) {
  if (!is_worker(damaged.rank)) return Verdict::unknown;
  hear(damaged.rank);
  ++faults_.damaged;
  const std::uint32_t task = index_of(damaged.task);
  if (task < tasks_.size() && lose(damaged.rank, task) && tasks_[task].holder == damaged.rank) {
    release(task);
    ++faults_.reissued;
  }
  Member& member = members_[damaged.rank];
  if (++member.broken == kMostBroken && member.where == Where::present) fall_silent(damaged.rank);
  return Verdict::accepted;
}

Verdict MasterModel::on(const Alive& alive) {
  if (!is_worker(alive.rank)) return Verdict::unknown;
  hear(alive.rank);
  return Verdict::accepted;
}

Verdict MasterModel::on(const Bye& bye) {
  if (!is_worker(bye.rank)) return Verdict::unknown;
  Member& member = members_[bye.rank];
  if (member.where == Where::gone) return Verdict::duplicate;
  if (member.where != Where::leaving && member.where != Where::given_up) return Verdict::unassigned;
  const bool is_late = member.where == Where::given_up;
  member.where = Where::gone;
  return is_late ? Verdict::late : Verdict::accepted;
}

Verdict MasterModel::on(const Tick&) {
  is_heard_ = true;
  for (Rank rank = 1; rank < members_.size(); ++rank) {
    Member& member = members_[rank];
    if (now_s_ - member.heard_s <= plan_.lease_s) continue;
    if (member.where == Where::leaving) member.is_overdue = true;
    if (member.where != Where::present || member.has.empty()) continue;
    ++faults_.silences;
    fall_silent(rank);
  }
  return Verdict::accepted;
}

void MasterModel::want(const Action& action) {
  promise(is_heard_, "nothing follows from what is refused");
  std::visit([&](const auto& wanted) { check(wanted); }, action);
}

void MasterModel::check(const Assign& assign) {
  Member& member = members_.at(assign.rank);
  promise(member.where == Where::present, "only who is present gets tasks");
  promise(!is_done(), "there are no tasks when all is done");
  promise(!assign.runs.empty(), "an assignment is not empty");
  if (member.has.empty()) member.heard_s = now_s_;
  for (const TaskRun& run : assign.runs) promise(run.count > 0, "no run is empty");
  for_each_task(assign.runs, [&](std::uint32_t task) {
    promise(task < tasks_.size(), "an assigned task exists");
    promise(!tasks_[task].accepted, "what is done is not handed out");
    promise(!tasks_[task].holder, "what somebody is counted on for is not handed out");
    hand_out(task, assign.rank);
  });
  promise(member.has.size() <= limit(assign.rank), "a rank holds no more than its policy allows");
}

void MasterModel::check(const AskBack& ask) {
  promise(is_worker(ask.rank), "only workers are asked");
  Member& member = members_[ask.rank];
  // Its third broken result may be what it is heard of by
  promise(member.where == Where::present || member.broken == kMostBroken, "only who is present is asked");
  // What is returned without a question is taken for the answer to the one that it brings about
  promise(!member.asked, "one question at a time");
  promise(ask.tasks > 0, "nobody is asked for nothing");
  promise(ask.tasks <= std::max(member.has.size(), member.had), "nobody is asked for more than it has or had just now");
  member.asked = answering_ != ask.rank;
}

void MasterModel::check(const Stop& stop) {
  promise(is_worker(stop.rank), "only workers are sent home");
  promise(is_done(), "nobody is sent home before all is done");
  Member& member = members_[stop.rank];
  promise(member.where == Where::present || member.where == Where::silent, "nobody is sent home twice");
  if (member.where == Where::present || member.broken >= kMostBroken) member.heard_s = now_s_;
  member.where = Where::leaving;
}

void MasterModel::check(const GiveUp& give_up) {
  promise(is_worker(give_up.rank), "only workers are given up");
  Member& member = members_[give_up.rank];
  promise(member.is_overdue, "nobody is given up who can still answer in time");
  member.is_overdue = false;
  member.where = Where::given_up;
}

void MasterModel::check(const Done&) {
  promise(is_done() && !tasks_.empty(), "done is when all is accepted");
  promise(++dones_ == 1, "done comes once");
  members_[kMasterRank].where = Where::gone;
}

void MasterModel::compare_with(const Master& master) const {
  promise(master.accepted() == accepted_, "it counts what is accepted");
  promise(master.is_done() == is_done(), "it knows when all is done");
  promise(dones_ == (is_done() && !tasks_.empty() ? 1U : 0U), "done comes with the last acceptance");
  bool somebody_is_present = false;
  bool somebody_is_there = false;
  for (Rank rank = 0; rank < members_.size(); ++rank) {
    const Member& member = members_[rank];
    promise(master.held_by(rank) == member.has.size(), "it knows what a rank has");
    promise(!member.is_overdue, "who does not go home is given up");
    if (member.where == Where::present && !is_done()) {
      promise(!member.has.empty() || !could_have_work(rank), "nobody who is present is idle while there is work");
    }
    if (rank == kMasterRank) continue;
    somebody_is_present |= member.where == Where::present;
    somebody_is_there |= member.where != Where::gone && member.where != Where::given_up;
    if (!is_done()) continue;
    const bool is_on_its_way = member.where != Where::present && member.where != Where::silent;
    promise(is_on_its_way || (tasks_.empty() && !member.greeted), "everybody is sent home when all is done");
  }
  promise(master.is_deserted() == !somebody_is_present, "it knows when it is alone");
  promise(master.is_over() == (is_done() && !somebody_is_there), "it is over when all is done and nobody is there");
  promise(master.faults() == faults_, "it counts what went wrong");
}

bool MasterModel::could_have_work(Rank rank) const {
  return open_again_ > 0 || untouched_[untouched_.size() == 1 ? 0 : rank] > 0;
}

std::uint32_t MasterModel::limit(Rank rank) const {
  if (rank == kMasterRank) return 1;
  if (is_chunked(plan_.policy)) return plan_.prefetch.value_or(1) - 1 + longest_chunk();
  return plan_.prefetch.value_or(plan_.policy == Policy::self_scheduling ? 1 : 16);
}

// Chunks of predicted work may hold any number of tasks.
std::uint32_t MasterModel::longest_chunk() const {
  if (!plan_.costs.empty()) return plan_.tasks;
  const auto ranks = static_cast<std::uint32_t>(members_.size());
  const std::uint32_t parts = plan_.policy == Policy::guided ? ranks : 2 * ranks;
  return (plan_.tasks + parts - 1) / parts;
}

void MasterModel::hand_out(std::uint32_t task, Rank rank) {
  if (tasks_[task].touched) {
    --open_again_;
  } else {
    promise(open_again_ == 0, "what is handed out again comes before all others");
    promise(untouched_.size() == 1 || task % untouched_.size() == rank, "a task goes to its owner first");
    --untouched_[task % untouched_.size()];
  }
  tasks_[task].touched = true;
  tasks_[task].holder = rank;
  members_[rank].has.push_back(task);
}

// Whoever is heard of is there again, and is counted on for what it has and nobody else does.
void MasterModel::hear(Rank rank) {
  is_heard_ = true;
  Member& member = members_[rank];
  member.heard_s = now_s_;
  member.had = member.has.size();
  if (member.where != Where::silent || member.broken >= kMostBroken) return;
  member.where = Where::present;
  for (const std::uint32_t task : member.has) {
    if (tasks_[task].accepted || tasks_[task].holder) continue;
    tasks_[task].holder = rank;
    --open_again_;
  }
}

void MasterModel::fall_silent(Rank rank) {
  members_[rank].where = Where::silent;
  for (std::uint32_t task = 0; task < tasks_.size(); ++task) {
    if (tasks_[task].holder != rank) continue;
    release(task);
    ++faults_.reissued;
  }
  // What it owns is everybody's from now on
  if (!has_owners(plan_.policy)) return;
  for (std::uint32_t task = rank; task < tasks_.size(); task += static_cast<std::uint32_t>(members_.size())) {
    if (tasks_[task].touched) continue;
    tasks_[task].touched = true;
    --untouched_[rank];
    ++open_again_;
  }
}

void MasterModel::release(std::uint32_t task) {
  tasks_[task].holder.reset();
  ++open_again_;
}

// Whether the rank had it.
bool MasterModel::lose(Rank rank, std::uint32_t task) {
  std::vector<std::uint32_t>& has = members_[rank].has;
  const auto found = std::find(has.begin(), has.end(), task);
  if (found == has.end()) return false;
  has.erase(found);
  return true;
}

}  // namespace tessera::scheduler
