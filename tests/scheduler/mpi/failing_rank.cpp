// SPDX-License-Identifier: BSD-3-Clause
// A render whose master or worker fails on the way: "failing_rank master|worker|uncaught" under mpirun. The job must
// end with the failing rank's code, 65, or 70 where nobody caught the exception.
#include <exception>
#include <stdexcept>
#include <string_view>

#include "scheduler/mpi/session.h"
#include "scheduler/mpi/transport.h"
#include "scheduler/run.h"

namespace {

using namespace tessera::scheduler;

Bytes render(TaskId task, const std::function<void()>& between_slices, bool fails) {
  if (fails && index_of(task) >= 100) throw std::runtime_error("this rank fails");
  between_slices();
  return Bytes(1000);
}

void take_part(mpi::Session& session, bool fails) {
  mpi::MpiTransport transport(session);
  const Work work = [&](TaskId task, const auto& between_slices) { return render(task, between_slices, fails); };
  session.barrier();
  if (session.rank() != kMasterRank) return run_worker(transport, work);
  Plan plan;
  plan.tasks = 100'000;
  plan.role = MasterRole::rendering;
  run_master(transport, plan, work, [](TaskId, auto) {});
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view who = argc > 1 ? argv[1] : "";
  try {
    mpi::Session session(argc, argv);
    const bool fails = session.rank() == (who == "master" ? kMasterRank : session.size() - 1);
    if (who == "uncaught") {
      take_part(session, fails);
      return 0;
    }
    try {
      take_part(session, fails);
    } catch (const std::exception&) {
      session.abort(65);
    }
  } catch (const std::exception&) {
    return 1;  // too late: the session has gone
  }
}
