// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/master_run.h"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "scheduler/host.h"

namespace tessera::scheduler {
namespace {

// A rank that is silent for a lease is missed within a tenth of one.
constexpr double kTicksPerLease = 10;

[[noreturn]] void refuse(Rank from, std::string_view reason) {
  throw std::runtime_error("rank " + std::to_string(from) + " sent a message that rank 0 cannot accept (" +
                           std::string(reason) + ")");
}

std::string_view problem_with(Verdict verdict) {
  switch (verdict) {
    case Verdict::accepted:
    case Verdict::late:
      break;
    case Verdict::duplicate:
      return "it came before";
    case Verdict::unassigned:
      return "it is about a task that the rank does not hold, or a goodbye that nobody asked for";
    case Verdict::unknown:
      return "there is no such rank or task";
  }
  return {};
}

template <class Happened>
Rank rank_of(const Happened& happened) noexcept {
  if constexpr (requires { happened.rank; }) {
    return happened.rank;
  } else {
    return kMasterRank;
  }
}

Traffic total(const Transport& transport) {
  return {transport.sent().count + transport.received().count, transport.sent().bytes + transport.received().bytes};
}

}  // namespace

MasterRun::MasterRun(Transport& transport, Plan plan, Work work, Accept accept, const Stopwatch& clock)
    : transport_(transport),
      plan_(std::move(plan)),
      accept_(std::move(accept)),
      clock_(clock),
      master_(plan_, transport.size()),
      work_(std::move(work), clock_, [this] { serve(); }),
      processes_(transport.size()),
      before_(total(transport)) {
  record_.tasks.resize(plan_.tasks);
  record_.ranks.resize(transport.size());
  for (Rank rank = 0; rank < transport.size(); ++rank) record_.ranks[rank].rank = rank;
  record_.ranks[kMasterRank].host = host_name();
}

Step MasterRun::step() {
  if (master_.is_over()) {
    transport_.flush();
    return Step::finished;
  }
  const bool got_messages = serve();
  update_own_seat();
  const std::optional<TaskId> task = own_.next();
  if (task) render(*task);
  return task || got_messages ? Step::worked : Step::idle;
}

bool MasterRun::serve() {
  bool got_messages = false;
  while (const std::optional<Envelope> envelope = transport_.receive()) {
    got_messages = true;
    std::visit([&](const auto& message) { on(envelope->source, message); }, decode(envelope->bytes));
  }
  if (clock_.seconds() >= next_tick_s_) {
    tell_master(Tick{}, clock_.seconds());
    next_tick_s_ = clock_.seconds() + plan_.lease_s / kTicksPerLease;
  }
  return got_messages;
}

void MasterRun::on(Rank from, const HelloMessage& hello) {
  tell_master(Hello{from}, clock_.seconds());
  record_.ranks[from].host = hello.host;
  processes_[from] = hello.pid;
}

void MasterRun::on(Rank from, const ResultMessage& result) {
  const double received_s = clock_.seconds();
  // The answer goes out first: the worker needs it more urgently than the picture needs the pixels.
  const double busy_s = seconds_from_ns(result.busy_ns);
  if (tell_master(Result{from, result.task, busy_s, seconds_from_ns(result.start_ns)}, received_s) == Verdict::late) {
    record_.faults.wasted_s += busy_s;
    return;
  }
  accept_(result.task, result.payload);

  // Take down what happened.
  busy_ns_ += result.busy_ns;
  RankRecord& rank = record_.ranks[from];
  ++rank.tasks;
  rank.busy_s += busy_s;
  TaskRecord& task = record_.tasks[index_of(result.task)];
  // A task that went out again may come from the rank that had it before.
  const double assigned_s = task.rank == from ? task.assigned_s : 0;
  task = {
      .task = result.task,
      .rank = from,
      .start_s = seconds_from_ns(result.start_ns),
      .end_s = seconds_from_ns(result.start_ns + result.busy_ns),
      .bytes = result.payload.size(),
      .assigned_s = assigned_s,
      .received_s = received_s,
      .accepted_s = clock_.seconds(),
  };
  if (master_.is_done()) record_.makespan_s = seconds_from_ns(clock_.elapsed_ns());
}

void MasterRun::on(Rank from, const DamagedMessage& damaged) {
  tell_master(Damaged{from, damaged.task}, clock_.seconds());
}
void MasterRun::on(Rank from, const ReturnMessage& returned) {
  tell_master(Returned{from, returned.runs}, clock_.seconds());
}
void MasterRun::on(Rank from, const AliveMessage&) {
  tell_master(Alive{from}, clock_.seconds());
}
void MasterRun::on(Rank from, const ByeMessage&) {
  // It went home after all.
  if (tell_master(Bye{from}, clock_.seconds()) == Verdict::late) {
    std::erase_if(record_.lost, [&](const LostRank& lost) { return lost.rank == from; });
  }
}
void MasterRun::on(Rank from, const Malformed& malformed) {
  refuse(from, malformed.problem);
}
template <class Other>
void MasterRun::on(Rank from, const Other&) {
  refuse(from, "one that only rank 0 sends");
}

void MasterRun::render(TaskId task) {
  const TimedResult result = work_.run(task);
  update_own_seat();
  on(kMasterRank, ResultMessage{task, result.start_ns, result.busy_ns, result.payload});
}

void MasterRun::update_own_seat() {
  if (master_.is_done()) return;
  Workload load{.ranks = transport_.size(), .tasks = plan_.tasks, .mean_task_s = std::nullopt};
  if (master_.accepted() > 0) load.mean_task_s = seconds_from_ns(busy_ns_) / master_.accepted();
  const bool renders = should_render(plan_, load) || master_.is_deserted();
  if (renders == seated_) return;
  seated_ = renders;
  tell_master(renders ? Event{TakeSeat{}} : Event{LeaveSeat{}}, clock_.seconds());
}

Verdict MasterRun::tell_master(const Event& event, double now_s) {
  actions_.clear();
  const Verdict verdict = master_.handle(event, now_s, actions_);
  if (verdict != Verdict::accepted && verdict != Verdict::late) {
    refuse(std::visit([](const auto& happened) { return rank_of(happened); }, event), problem_with(verdict));
  }
  for (const Action& action : actions_) {
    std::visit([&](const auto& wanted) { perform(wanted, now_s); }, action);
  }
  return verdict;
}

void MasterRun::perform(const Assign& assign, double now_s) {
  for (const TaskRun& run : assign.runs) {
    const auto tasks = std::span(record_.tasks).subspan(index_of(run.first), run.count);
    for (TaskRecord& task : tasks) {
      task.rank = assign.rank;
      task.assigned_s = now_s;
    }
  }
  if (assign.rank == kMasterRank) {
    own_.assign(assign.runs);
  } else {
    transport_.send(assign.rank, encode(AssignMessage{assign.runs}));
  }
}

void MasterRun::perform(const AskBack& ask, double) {
  transport_.send(ask.rank, encode(BackMessage{ask.tasks}));
}

void MasterRun::perform(const Stop& stop, double) {
  transport_.send(stop.rank, encode(StopMessage{}));
}

void MasterRun::perform(const GiveUp& give_up, double) {
  transport_.abandon(give_up.rank);
  record_.lost.push_back({give_up.rank, record_.ranks[give_up.rank].host, processes_[give_up.rank]});
}

void MasterRun::perform(const Done&, double) {}  // the makespan is taken once the result is in its place

RunRecord MasterRun::take_record() {
  for (RankRecord& rank : record_.ranks) rank.wait_s = std::max(0.0, record_.makespan_s - rank.busy_s);
  const Traffic now = total(transport_);
  const double wasted_s = record_.faults.wasted_s;
  record_.faults = master_.faults();
  record_.faults.wasted_s = wasted_s;
  record_.messages = {now.count - before_.count, now.bytes - before_.bytes};
  record_.clock = clock_;
  return std::move(record_);
}

}  // namespace tessera::scheduler
