// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/worker_run.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "scheduler/host.h"
#include "scheduler/master.h"

namespace tessera::scheduler {
namespace {

// Rank 0 misses a rank that is silent for a lease. Several signs may be late before it does.
constexpr double kSignsPerLease = 4;

/// Thrown through a task that nobody waits for any more.
struct SentHome {};

[[noreturn]] void refuse(std::string_view reason) {
  throw std::runtime_error("rank 0 sent a message that a worker cannot follow (" + std::string(reason) + ")");
}

}  // namespace

WorkerRun::WorkerRun(Transport& transport, const Plan& plan, Work work, const Stopwatch& clock)
    : transport_(transport),
      clock_(clock),
      work_(std::move(work), clock_, [this] { look_up_from_task(); }),
      sign_every_s_(plan.lease_s / kSignsPerLease) {
  send(encode(HelloMessage{process_id(), host_name()}));
  worker_.assign(first_tasks(plan, transport.size())[transport.rank()]);
}

Step WorkerRun::step() {
  const bool got_messages = take_messages();
  if (worker_.is_stopped()) return go_home();
  const std::optional<TaskId> task = worker_.next();
  if (!task) return got_messages ? Step::worked : Step::idle;
  try {
    const TimedResult result = work_.run(*task);
    send(encode_header({*task, result.start_ns, result.busy_ns, result.payload}), result.payload);
  } catch (const SentHome&) {
    return go_home();
  }
  return Step::worked;
}

Step WorkerRun::go_home() {
  // What was sent before must not arrive after the goodbye.
  transport_.flush();
  send(encode(ByeMessage{}));
  transport_.flush();
  return Step::finished;
}

bool WorkerRun::take_messages() {
  bool got_messages = false;
  while (const std::optional<Envelope> envelope = transport_.receive()) {
    got_messages = true;
    std::visit([&](const auto& message) { on(message); }, decode(envelope->bytes));
  }
  return got_messages;
}

void WorkerRun::look_up_from_task() {
  take_messages();
  if (worker_.is_stopped()) throw SentHome{};
  if (clock_.seconds() >= next_sign_s_) send(encode(AliveMessage{}));
}

void WorkerRun::send(std::span<const std::byte> head, std::span<const std::byte> rest) {
  transport_.send(kMasterRank, head, rest);
  next_sign_s_ = clock_.seconds() + sign_every_s_;
}

void WorkerRun::on(const AssignMessage& assign) {
  worker_.assign(assign.runs);
}
void WorkerRun::on(const BackMessage& back) {
  send(encode(ReturnMessage{worker_.give_back(back.tasks)}));
}
void WorkerRun::on(const StopMessage&) {
  worker_.stop();
}
void WorkerRun::on(const Malformed& malformed) {
  refuse(malformed.problem);
}
template <class Other>
void WorkerRun::on(const Other&) {
  refuse("one that only workers send");
}

}  // namespace tessera::scheduler
