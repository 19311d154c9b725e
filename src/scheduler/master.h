// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "scheduler/plan.h"
#include "scheduler/task.h"
#include "scheduler/task_queue.h"

// The scheduler itself: what happened goes in, what to do about it comes out. It has no clock, no thread and no wire,
// so the same object runs over MPI, in one process, and in tests that try thousands of histories.
namespace tessera::scheduler {

/// A rank is there and asks for work. One that left may come again.
struct Hello {
  Rank rank = 0;
};
/// A rank asks for no more work; what it holds, it still delivers.
struct Leave {
  Rank rank = 0;
};
/// A rank delivers a task and thereby asks for more.
struct Result {
  Rank rank = 0;
  TaskId task{};
  double busy_s = 0;  ///< time it took
};
using Event = std::variant<Hello, Leave, Result>;

/// Hand these tasks to a rank.
struct Assign {
  Rank rank = 0;
  RunList runs;
};
/// Send a worker home.
struct Stop {
  Rank rank = 0;
};
/// Every task is accepted.
struct Done {};
using Action = std::variant<Assign, Stop, Done>;

/// What the master made of an event. Only `accepted` changes anything.
enum class Verdict : std::uint8_t {
  accepted,
  duplicate,   ///< the task was accepted before, the rank is there already, or it left already
  unassigned,  ///< the rank does not hold the task
  unknown,     ///< there is no such rank or task
};

/// Invariants, whatever comes in and in which order:
///   - each task is accepted exactly once, from the rank that it was assigned to;
///   - a rank never holds more than its policy allows, and gets nothing before its Hello or after it left;
///   - Done comes with the last acceptance, and a Stop for every worker that is there; one whose Hello comes later
///     gets its Stop at once. Rank 0 gets no Stop.
/// A plan without tasks is done from the start, without an action to say so.
class Master {
 public:
  /// throws:  std::invalid_argument where the plan is not feasible
  Master(const Plan& plan, std::uint32_t ranks);

  /// Takes one event and appends what follows from it to `out`, in O(1) per task assigned.
  /// throws:  what growing `out` may throw, nothing where it has room for ranks + 1 actions
  Verdict handle(const Event& event, std::vector<Action>& out);

  bool is_done() const noexcept { return accepted_ == holder_.size(); }
  std::uint32_t accepted() const noexcept { return accepted_; }
  std::uint32_t held_by(Rank rank) const noexcept { return seats_[rank].held; }

 private:
  enum class Presence : std::uint8_t { absent, present, stopped };

  /// What the master knows of a rank.
  struct Seat {
    Presence presence = Presence::absent;
    std::uint32_t held = 0;
    std::uint32_t delivered = 0;
    double mean_task_s = 0;
  };

  Verdict on(const Hello& hello, std::vector<Action>& out);
  Verdict on(const Leave& leave, std::vector<Action>& out);
  Verdict on(const Result& result, std::vector<Action>& out);
  void refill(Rank rank, std::vector<Action>& out);
  void stop(Rank rank, std::vector<Action>& out);
  void finish(std::vector<Action>& out);

  Policy policy_;
  std::optional<unsigned> prefetch_;
  TaskQueue queue_;
  std::vector<Seat> seats_;
  std::vector<Rank> holder_;  ///< task -> the rank that holds it, or one of two marks
  std::uint32_t accepted_ = 0;
};

}  // namespace tessera::scheduler
