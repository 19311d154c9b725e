// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scheduler/message.h"
#include "scheduler/stepper.h"
#include "scheduler/stopwatch.h"
#include "scheduler/timed_work.h"
#include "scheduler/transport.h"
#include "scheduler/work.h"
#include "scheduler/worker.h"

namespace tessera::scheduler {

/// Joins a Worker to a transport and a clock: says hello, then renders what comes until it is sent home.
class WorkerRun {
 public:
  /// Says hello; the rank's clock starts here. `transport` must outlive this.
  WorkerRun(Transport& transport, Work work);

  /// Takes the messages that are here and does at most one task.
  /// throws:  std::runtime_error on a message that a worker cannot get; what `work` throws
  Step step();

 private:
  bool take_messages();
  void on(const AssignMessage& assign);
  void on(const StopMessage& stop);
  void on(const Malformed& malformed);
  void on(const HelloMessage& hello);
  void on(const ResultMessage& result);

  Transport& transport_;
  Stopwatch clock_;
  TimedWork work_;
  Worker worker_;
};

}  // namespace tessera::scheduler
