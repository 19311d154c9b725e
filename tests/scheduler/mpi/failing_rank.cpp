// SPDX-License-Identifier: BSD-3-Clause
// A render whose master or worker fails on the way: "failing_rank master|worker|uncaught" under mpirun. The job must
// end with the failing rank's code, 65, or 70 where nobody caught the exception. With "killed", the last rank kills
// itself in the middle of a task; under mpirun --enable-recovery the others do its work and end with 0.
#include <csignal>
#include <exception>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "scheduler/mpi/farewell.h"
#include "scheduler/mpi/session.h"
#include "scheduler/mpi/transport.h"
#include "scheduler/run.h"

namespace {

using namespace tessera::scheduler;

enum class Failure { none, throws, is_killed };

Bytes render(TaskId task, const std::function<void()>& between_slices, Failure failure) {
  between_slices();
  if (index_of(task) >= 100 && failure == Failure::throws) throw std::runtime_error("this rank fails");
  if (index_of(task) >= 100 && failure == Failure::is_killed) std::raise(SIGKILL);
  return Bytes(1000);
}

void take_part(mpi::Session& session, Failure failure) {
  mpi::MpiTransport transport(session);
  const Work work = [&](TaskId task, const auto& between_slices) { return render(task, between_slices, failure); };
  Plan plan;
  plan.tasks = 100'000;
  plan.role = MasterRole::rendering;
  plan.lease_s = 0.5;
  session.barrier();
  if (session.rank() != kMasterRank) {
    run_worker(transport, plan, work);
    return mpi::await_dismissal(session);
  }
  std::vector<int> times(plan.tasks, 0);
  const RunRecord run = run_master(transport, plan, work, [&](TaskId task, auto) { ++times[index_of(task)]; });
  for (const int count : times) {
    if (count != 1) session.abort(1);
  }
  mpi::dismiss(session, run);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view who = argc > 1 ? argv[1] : "";
  try {
    mpi::Session session(argc, argv);
    const bool fails = session.rank() == (who == "master" ? kMasterRank : session.size() - 1);
    const Failure failure = !fails ? Failure::none : who == "killed" ? Failure::is_killed : Failure::throws;
    if (who == "uncaught") {
      take_part(session, failure);
      return 0;
    }
    try {
      take_part(session, failure);
    } catch (const std::exception&) {
      session.abort(65);
    }
  } catch (const std::exception&) {
    return 1;  // too late: the session has gone
  }
}
