// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scheduler/master.h"
#include "scheduler/message.h"
#include "scheduler/plan.h"
#include "scheduler/record.h"
#include "scheduler/stepper.h"
#include "scheduler/stopwatch.h"
#include "scheduler/timed_work.h"
#include "scheduler/transport.h"
#include "scheduler/work.h"
#include "scheduler/worker.h"

namespace tessera::scheduler {

/// Joins a Master to a transport and a clock, and to a Worker of its own where rank 0 renders as well. Between the
/// slices of its own task it answers the others at once.
/// With one rank it is the same, and no message is sent.
class MasterRun {
 public:
  /// The times of the record are those of `clock`. `transport` must outlive this.
  /// throws:  std::invalid_argument where the plan is not feasible
  MasterRun(Transport& transport, Plan plan, Work work, Accept accept, const Stopwatch& clock = Stopwatch());

  /// Takes the messages that are here and does at most one task of its own.
  /// throws:  std::runtime_error on a message that breaks the protocol; what `work` and `accept` throw
  Step step();

  /// What happened, complete once finished.
  RunRecord take_record();

 private:
  bool serve();
  void on(Rank from, const HelloMessage& hello);
  void on(Rank from, const ResultMessage& result);
  void on(Rank from, const DamagedMessage& damaged);
  void on(Rank from, const ReturnMessage& returned);
  void on(Rank from, const AliveMessage& alive);
  void on(Rank from, const ByeMessage& bye);
  void on(Rank from, const Malformed& malformed);
  template <class Other>
  void on(Rank from, const Other& other);

  void render(TaskId task);
  void update_own_seat();
  Verdict tell_master(const Event& event, double now_s);
  void perform(const Assign& assign, double now_s);
  void perform(const AskBack& ask, double now_s);
  void perform(const Stop& stop, double now_s);
  void perform(const GiveUp& give_up, double now_s);
  void perform(const Done& done, double now_s);

  Transport& transport_;
  Plan plan_;
  Accept accept_;
  Stopwatch clock_;
  Master master_;
  std::vector<Action> actions_;
  TimedWork work_;
  Worker own_;
  bool seated_ = false;  ///< whether rank 0 takes tasks of its own
  double next_tick_s_ = 0;
  std::uint64_t busy_ns_ = 0;             ///< of all accepted tasks
  std::vector<std::uint32_t> processes_;  ///< per rank, 0 before its hello
  Traffic before_;
  RunRecord record_;
};

}  // namespace tessera::scheduler
