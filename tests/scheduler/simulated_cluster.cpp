// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/simulated_cluster.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <queue>
#include <variant>

#include "scheduler/master.h"
#include "scheduler/worker.h"

namespace tessera::scheduler {
namespace {

class Simulation {
 public:
  Simulation(const Cluster& cluster, const Plan& plan, const std::vector<double>& task_s)
      : cluster_(cluster),
        plan_(plan),
        task_s_(task_s),
        master_(plan, cluster.ranks),
        workers_(cluster.ranks),
        working_(cluster.ranks),
        busy_s_(cluster.ranks),
        last_end_s_(cluster.ranks) {}

  SimulatedRun run() {
    const std::vector<RunList> first = first_tasks(plan_, cluster_.ranks);
    for (Rank rank = 1; rank < cluster_.ranks; ++rank) {
      send_to_master(0, Hello{rank});
      workers_[rank].assign(first[rank]);
      begin_next(rank);
    }
    at(0, MasterFree{});
    while (!agenda_.empty()) {
      const Entry entry = agenda_.top();
      agenda_.pop();
      now_s_ = entry.time_s;
      std::visit([&](const auto& happened) { on(happened); }, entry.what);
    }
    return summary();
  }

 private:
  /// What can happen, and when.
  struct Mail {
    Event event;
  };
  struct MasterFree {};
  struct Assigned {
    Rank rank = 0;
    RunList runs;
  };
  struct AskedBack {
    Rank rank = 0;
    std::uint32_t tasks = 0;
  };
  struct Finished {
    Rank rank = 0;
    TaskId task{};
    double start_s = 0;
  };
  struct Entry {
    double time_s = 0;
    std::uint64_t number = 0;  ///< what was planned earlier comes first among equals
    std::variant<Mail, MasterFree, Assigned, AskedBack, Finished> what;

    friend bool operator<(const Entry& a, const Entry& b) noexcept {
      return a.time_s != b.time_s ? a.time_s > b.time_s : a.number > b.number;
    }
  };

  template <class What>
  void at(double time_s, What what) {
    agenda_.push({time_s, planned_++, std::move(what)});
  }

  void send_to_master(double time_s, const Event& event) {
    ++messages_;
    at(time_s + cluster_.one_way_s, Mail{event});
  }

  void on(const Mail& mail) {
    mailbox_.push_back(mail.event);
    if (!master_is_busy_) go_on();
  }

  void on(const MasterFree&) {
    master_is_busy_ = false;
    go_on();
  }

  void on(const Assigned& assigned) {
    workers_[assigned.rank].assign(assigned.runs);
    if (!working_[assigned.rank]) begin_next(assigned.rank);
  }

  void on(const AskedBack& asked) {
    send_to_master(now_s_, Returned{asked.rank, workers_[asked.rank].give_back(asked.tasks)});
  }

  void on(const Finished& finished) {
    working_[finished.rank] = false;
    note(finished.rank, finished.task);
    send_to_master(now_s_, result_of(finished));
    begin_next(finished.rank);
  }

  /// Rank 0 takes the next message or, if there is none, a slice of its own task.
  void go_on() {
    if (!mailbox_.empty()) {
      const Event event = mailbox_.front();
      mailbox_.pop_front();
      master_is_busy_ = true;
      const double done_s = now_s_ + cluster_.master_per_message_s;
      tell_master(event, done_s);
      at(done_s, MasterFree{});
      return;
    }
    update_own_seat();
    if (!own_) {
      const std::optional<TaskId> task = workers_[kMasterRank].next();
      if (!task) return;
      own_ = Finished{kMasterRank, *task, now_s_};
      own_left_s_ = task_s_[index_of(*task)];
    }
    // A slice, and the result at the end of the last one.
    const double slice_s = std::min(own_left_s_, cluster_.slice_s);
    own_left_s_ -= slice_s;
    master_is_busy_ = true;
    at(now_s_ + slice_s, MasterFree{});
    if (own_left_s_ > 0) return;
    const Finished finished = *own_;
    own_.reset();
    const double end_s = now_s_ + slice_s;
    note(kMasterRank, finished.task, end_s);
    tell_master(result_of(finished), end_s);
  }

  void tell_master(const Event& event, double time_s) {
    actions_.clear();
    master_.handle(event, time_s, actions_);
    if (const auto* result = std::get_if<Result>(&event)) accepted_s_ += result->busy_s;
    for (const Action& action : actions_) {
      if (const auto* ask = std::get_if<AskBack>(&action)) {
        ++messages_;
        at(time_s + cluster_.one_way_s, AskedBack{ask->rank, ask->tasks});
      }
      const auto* assign = std::get_if<Assign>(&action);
      if (assign == nullptr) continue;
      if (assign->rank == kMasterRank) {
        workers_[kMasterRank].assign(assign->runs);
        continue;
      }
      ++messages_;
      at(time_s + cluster_.one_way_s, Assigned{assign->rank, assign->runs});
    }
    if (master_.is_done()) makespan_s_ = time_s;
  }

  void update_own_seat() {
    if (master_.is_done()) return;
    Workload load{.ranks = cluster_.ranks, .tasks = plan_.tasks, .mean_task_s = std::nullopt};
    if (master_.accepted() > 0) load.mean_task_s = accepted_s_ / master_.accepted();
    const bool renders = should_render(plan_, load);
    if (renders == seated_) return;
    seated_ = renders;
    tell_master(renders ? Event{TakeSeat{}} : Event{LeaveSeat{}}, now_s_);
  }

  void begin_next(Rank rank) {
    const std::optional<TaskId> task = workers_[rank].next();
    if (!task) return;
    working_[rank] = true;
    at(now_s_ + task_s_[index_of(*task)], Finished{rank, *task, now_s_});
  }

  Result result_of(const Finished& finished) const {
    return {finished.rank, finished.task, task_s_[index_of(finished.task)], finished.start_s};
  }

  void note(Rank rank, TaskId task) { note(rank, task, now_s_); }
  void note(Rank rank, TaskId task, double end_s) {
    busy_s_[rank] += task_s_[index_of(task)];
    last_end_s_[rank] = end_s;
  }

  SimulatedRun summary() const {
    SimulatedRun run;
    run.makespan_s = makespan_s_;
    run.messages = messages_;
    double longest_s = 0;
    double first_idle_s = makespan_s_;
    for (Rank rank = 0; rank < cluster_.ranks; ++rank) {
      run.busy_s += busy_s_[rank];
      longest_s = std::max(longest_s, busy_s_[rank]);
      if (rank != kMasterRank || busy_s_[rank] > 0) first_idle_s = std::min(first_idle_s, last_end_s_[rank]);
    }
    run.tail_s = makespan_s_ - first_idle_s;
    if (run.busy_s > 0) run.imbalance = longest_s * cluster_.ranks / run.busy_s - 1;
    if (makespan_s_ > 0) run.efficiency = run.busy_s / (cluster_.ranks * makespan_s_);
    return run;
  }

  const Cluster& cluster_;
  const Plan& plan_;
  const std::vector<double>& task_s_;
  Master master_;
  std::vector<Worker> workers_;
  std::vector<bool> working_;
  std::vector<double> busy_s_;
  std::vector<double> last_end_s_;

  double now_s_ = 0;
  std::uint64_t planned_ = 0;
  std::priority_queue<Entry> agenda_;
  std::deque<Event> mailbox_;
  std::vector<Action> actions_;
  bool master_is_busy_ = true;  ///< until its first MasterFree
  bool seated_ = false;
  std::optional<Finished> own_;  ///< rank 0's own task
  double own_left_s_ = 0;
  double accepted_s_ = 0;
  double makespan_s_ = 0;
  std::uint64_t messages_ = 0;
};

}  // namespace

SimulatedRun simulate(const Cluster& cluster, const Plan& plan, const std::vector<double>& task_s) {
  return Simulation(cluster, plan, task_s).run();
}

}  // namespace tessera::scheduler
