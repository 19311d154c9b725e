// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

#include "scheduler/ledger.h"
#include "scheduler/plan.h"
#include "scheduler/record.h"
#include "scheduler/task.h"
#include "scheduler/task_queue.h"

// The scheduler itself: what happened goes in, what to do about it comes out. It has no clock, no thread and no wire,
// so the same object runs over MPI, in one process, in simulation, and in tests that try thousands of histories.
namespace tessera::scheduler {

/// A worker says that it is there. It had its first tasks before, see first_tasks.
struct Hello {
  Rank rank = 0;
};
/// Rank 0 renders from now on, or asks for no more tasks; what it holds, it still delivers.
struct TakeSeat {};
struct LeaveSeat {};
/// A rank delivers a task and thereby asks for more.
struct Result {
  Rank rank = 0;
  TaskId task{};
  double busy_s = 0;   ///< time it took
  double start_s = 0;  ///< when it began, on the clock of the rank
};
/// A rank gives tasks up that it has not begun, perhaps none: the answer to AskBack.
struct Returned {
  Rank rank = 0;
  RunList runs;
};
/// What a rank delivered is broken; `task` is what it says of itself.
struct Damaged {
  Rank rank = 0;
  TaskId task{};
};
/// A rank works on and has nothing to deliver yet.
struct Alive {
  Rank rank = 0;
};
/// A worker leaves after a Stop.
struct Bye {
  Rank rank = 0;
};
/// Time has passed; to be told a few times per lease.
struct Tick {};
using Event = std::variant<Hello, TakeSeat, LeaveSeat, Result, Returned, Damaged, Alive, Bye, Tick>;

/// Hand these tasks to a rank.
struct Assign {
  Rank rank = 0;
  RunList runs;
};
/// Ask a worker to give back up to this many of the tasks that it has not begun.
struct AskBack {
  Rank rank = 0;
  std::uint32_t tasks = 0;
};
/// Send a worker home.
struct Stop {
  Rank rank = 0;
};
/// A worker did not go home: it is lost, and nobody waits for it.
struct GiveUp {
  Rank rank = 0;
};
/// Every task is accepted.
struct Done {};
using Action = std::variant<Assign, AskBack, Stop, GiveUp, Done>;

/// What the master made of an event. `accepted` and `late` are what a rank that follows the protocol can bring about.
enum class Verdict : std::uint8_t {
  accepted,
  late,        ///< another copy of the task was accepted before, or the worker was given up before it said goodbye
  duplicate,   ///< the rank delivered the task before, said hello before, has or has not its seat already
  unassigned,  ///< the rank does not hold the task, or was not sent home
  unknown,     ///< there is no such rank or task
};

/// Invariants, whatever comes in and in which order:
///   - each task is accepted exactly once, from a rank that it was assigned to;
///   - a rank never holds more than its policy allows, and gets nothing while it is silent or after its Stop;
///   - a worker that holds tasks and is not heard of for a lease is silent: its tasks are handed out again, before all
///     others, and the first copy that arrives counts; what it owns and has not had yet is everybody's; when it is
///     heard of again, it is as before;
///   - Done comes with the last acceptance, and a Stop for every worker; a worker that is then not heard of for a lease
///     is given up. Rank 0 is never silent, and gets no Stop.
/// A plan without tasks is done from the start, without an action to say so; its workers get their Stop with their
/// Hello.
class Master {
 public:
  /// Workers have their first tasks from the start. Time begins at 0.
  /// throws:  std::invalid_argument where the plan is not feasible
  Master(const Plan& plan, std::uint32_t ranks);

  /// Takes one event and appends what follows from it to `out`, in O(1) per task assigned; O(ranks) where tasks run out
  /// and at a Tick, O(tasks) where a rank falls silent.
  /// units:   now_s in seconds, never less than before
  Verdict handle(const Event& event, double now_s, std::vector<Action>& out);

  /// Whether every task is accepted.
  bool is_done() const noexcept { return ledger_.done() == ledger_.tasks(); }
  /// Whether it is done and no worker is there any more.
  bool is_over() const noexcept { return is_done() && workers_there_ == 0; }
  /// Whether no worker can be counted on, so that rank 0 has to do what is left.
  bool is_deserted() const noexcept { return workers_present_ == 0; }

  std::uint32_t accepted() const noexcept { return ledger_.done(); }
  std::uint32_t held_by(Rank rank) const noexcept { return ledger_.held_by(rank); }
  const Faults& faults() const noexcept { return faults_; }

 private:
  enum class Presence : std::uint8_t {
    away,     ///< rank 0 does not render
    present,  ///< gets tasks
    silent,   ///< holds tasks and was not heard of for a lease, or delivers rubbish
    leaving,  ///< has its Stop
    given_up,
    gone,
  };

  /// What the master knows of a rank.
  struct Seat {
    Presence presence = Presence::away;
    bool greeted = false;  ///< its Hello has come
    bool idle = false;     ///< stands in idle_
    bool asked = false;    ///< an AskBack is not answered yet
    /// Results that were damaged. Once there was one, the rank may have a task that it was not believed to have: the
    /// broken result gave that one's number for its own.
    std::uint32_t broken = 0;
    double heard_s = 0;  ///< when it was last heard of or given something to do
    std::uint32_t delivered = 0;
    double mean_task_s = 0;
    /// The shortest time from the end of a task to its arrival: the way to rank 0, and the time by which the rank's
    /// clock was started late.
    double way_s = std::numeric_limits<double>::infinity();
  };

  Verdict on(const Hello& hello, std::vector<Action>& out);
  Verdict on(const TakeSeat&, std::vector<Action>& out);
  Verdict on(const LeaveSeat&, std::vector<Action>& out);
  Verdict on(const Result& result, std::vector<Action>& out);
  Verdict on(const Returned& returned, std::vector<Action>& out);
  Verdict on(const Damaged& damaged, std::vector<Action>& out);
  Verdict on(const Alive& alive, std::vector<Action>& out);
  Verdict on(const Bye& bye, std::vector<Action>& out);
  Verdict on(const Tick&, std::vector<Action>& out);

  bool is_worker(Rank rank) const noexcept { return rank != kMasterRank && rank < seats_.size(); }
  bool is_task(TaskId task) const noexcept { return index_of(task) < ledger_.tasks(); }
  bool is_overdue(const Seat& seat) const noexcept { return now_s_ - seat.heard_s > plan_.lease_s; }
  RunList take(Rank rank);
  void hear(Rank rank, std::vector<Action>& out);
  bool give_up_task(Rank rank, TaskId task);
  void fall_silent(Rank rank);
  void refill(Rank rank, std::vector<Action>& out);
  void rest(Rank rank, std::vector<Action>& out);
  void feed_idle(std::vector<Action>& out);
  void ask_back(std::vector<Action>& out);
  void stop(Rank rank, std::vector<Action>& out);
  void finish(std::vector<Action>& out);

  Plan plan_;
  TaskQueue queue_;
  Ledger ledger_;
  std::vector<Seat> seats_;
  std::vector<Rank> idle_;  ///< present ranks that hold nothing, for there was nothing to give them
  std::uint32_t workers_there_;
  std::uint32_t workers_present_;
  double now_s_ = 0;
  Faults faults_;
};

/// What each worker begins with: it follows from the plan, so nobody has to tell it, and no time is lost over the way.
/// shapes:  one list per rank; that of rank 0 is empty
std::vector<RunList> first_tasks(const Plan& plan, std::uint32_t ranks);

}  // namespace tessera::scheduler
