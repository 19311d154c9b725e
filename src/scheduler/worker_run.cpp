// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/worker_run.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "scheduler/host.h"

namespace tessera::scheduler {
namespace {

[[noreturn]] void refuse(std::string_view reason) {
  throw std::runtime_error("rank 0 sent a message that a worker cannot follow (" + std::string(reason) + ")");
}

}  // namespace

WorkerRun::WorkerRun(Transport& transport, Work work)
    : transport_(transport), work_(std::move(work), clock_, [this] { take_messages(); }) {
  transport_.send(kMasterRank, encode(HelloMessage{process_id(), host_name()}));
}

Step WorkerRun::step() {
  const bool got_messages = take_messages();
  if (worker_.is_stopped()) {
    transport_.flush();
    return Step::finished;
  }
  const std::optional<TaskId> task = worker_.next();
  if (!task) return got_messages ? Step::worked : Step::idle;
  TimedResult result = work_.run(*task);
  transport_.send(kMasterRank,
                  encode(ResultMessage{*task, result.start_ns, result.busy_ns, {}}, std::move(result.payload)));
  return Step::worked;
}

bool WorkerRun::take_messages() {
  bool got_messages = false;
  while (const std::optional<Envelope> envelope = transport_.receive()) {
    got_messages = true;
    std::visit([&](const auto& message) { on(message); }, decode(envelope->bytes));
  }
  return got_messages;
}

void WorkerRun::on(const AssignMessage& assign) {
  worker_.assign(assign.runs);
}
void WorkerRun::on(const StopMessage&) {
  worker_.stop();
}
void WorkerRun::on(const Malformed& malformed) {
  refuse(malformed.problem);
}
void WorkerRun::on(const HelloMessage&) {
  refuse("a hello");
}
void WorkerRun::on(const ResultMessage&) {
  refuse("a result");
}

}  // namespace tessera::scheduler
