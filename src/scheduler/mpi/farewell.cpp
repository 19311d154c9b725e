// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/farewell.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scheduler/backoff.h"
#include "scheduler/host.h"
#include "scheduler/mpi/check.h"
#include "scheduler/mpi/communicator.h"
#include "scheduler/mpi/session.h"

namespace tessera::scheduler::mpi {
namespace {

constexpr int kTag = 1;  // the transport has 0

/// What rank 0 tells the others: 1 where a rank is lost, then the processes to end.
using Farewell = std::vector<std::uint32_t>;

bool is_lost(const RunRecord& run, Rank rank) {
  return std::any_of(run.lost.begin(), run.lost.end(), [&](const LostRank& lost) { return lost.rank == rank; });
}

/// The first rank on a host that is not lost, or nullptr.
const RankRecord* find_rank_on(const RunRecord& run, const std::string& host) {
  const auto found = std::find_if(run.ranks.begin(), run.ranks.end(), [&](const RankRecord& rank) {
    return rank.host == host && !is_lost(run, rank.rank);
  });
  return found == run.ranks.end() ? nullptr : &*found;
}

void act_on(Session& session, const Farewell& farewell) {
  for (const std::uint32_t process : std::span(farewell).subspan(1)) end_process(process);
  if (farewell[0] == 1) session.note_lost_rank();
}

}  // namespace

void dismiss(Session& session, const RunRecord& run) {
  const std::uint32_t is_lost_one = run.lost.empty() ? 0 : 1;
  std::vector<Farewell> farewells(session.size(), Farewell{is_lost_one});
  for (const LostRank& lost : run.lost) {
    const RankRecord* neighbour = find_rank_on(run, lost.host);
    if (neighbour != nullptr && lost.pid != 0) farewells[neighbour->rank].push_back(lost.pid);
  }
  for (Rank rank = 1; rank < session.size(); ++rank) {
    if (is_lost(run, rank)) continue;
    const Farewell& farewell = farewells[rank];
    // A rank that died since then needs no farewell.
    static_cast<void>(MPI_Send(farewell.data(), static_cast<int>(farewell.size()), MPI_UINT32_T, static_cast<int>(rank),
                               kTag, session.communicator().get()));
  }
  act_on(session, farewells[kMasterRank]);
}

void await_dismissal(Session& session) {
  Backoff backoff(session.patience());
  int found = 0;
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  while (true) {
    check(MPI_Improbe(static_cast<int>(kMasterRank), kTag, session.communicator().get(), &found, &message, &status),
          "MPI_Improbe");
    if (found != 0) break;
    backoff.wait();
  }
  int count = 0;
  check(MPI_Get_count(&status, MPI_UINT32_T, &count), "MPI_Get_count");
  Farewell farewell(static_cast<std::size_t>(count));
  check(MPI_Mrecv(farewell.data(), count, MPI_UINT32_T, &message, MPI_STATUS_IGNORE), "MPI_Mrecv");
  act_on(session, farewell);
}

}  // namespace tessera::scheduler::mpi
