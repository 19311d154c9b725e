// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scheduler/message.h"
#include "scheduler/plan.h"
#include "scheduler/stepper.h"
#include "scheduler/stopwatch.h"
#include "scheduler/timed_work.h"
#include "scheduler/transport.h"
#include "scheduler/work.h"
#include "scheduler/worker.h"

namespace tessera::scheduler {

/// Joins a Worker to a transport and a clock: says hello, renders what it begins with and what comes, gives a sign of
/// life where a task takes long, and goes when it is sent home, if need be from the middle of a task.
class WorkerRun {
 public:
  /// Says hello; the times of its results are those of `clock`. `transport` must outlive this; the plan is the same on
  /// all ranks.
  WorkerRun(Transport& transport, const Plan& plan, Work work, const Stopwatch& clock = Stopwatch());

  /// Takes the messages that are here and does at most one task.
  /// throws:  std::runtime_error on a message that a worker cannot get; what `work` throws
  Step step();

 private:
  bool take_messages();
  void look_up_from_task();
  void send(std::span<const std::byte> head, std::span<const std::byte> rest = {});
  Step go_home();

  void on(const AssignMessage& assign);
  void on(const BackMessage& back);
  void on(const StopMessage& stop);
  void on(const Malformed& malformed);
  template <class Other>
  void on(const Other& other);

  Transport& transport_;
  Stopwatch clock_;
  TimedWork work_;
  Worker worker_;
  double sign_every_s_;  ///< at least so often it is heard of while it has a task
  double next_sign_s_ = 0;
};

}  // namespace tessera::scheduler
