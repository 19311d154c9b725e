// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/clock_offset.h"

#include <array>
#include <cstdint>

#include "scheduler/backoff.h"
#include "scheduler/mpi/check.h"
#include "scheduler/mpi/communicator.h"

namespace tessera::scheduler::mpi {
namespace {

constexpr int kTag = 1;  // apart from the messages of a run

// The first questions may find the other rank asleep, and each may be held up on its way.
constexpr std::size_t kQuestions = 32;

void send(const Session& session, Rank to, std::uint64_t value) {
  check(MPI_Send(&value, 1, MPI_UINT64_T, static_cast<int>(to), kTag, session.communicator().get()), "MPI_Send");
}

std::uint64_t receive(const Session& session, Rank from) {
  std::uint64_t value = 0;
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Irecv(&value, 1, MPI_UINT64_T, static_cast<int>(from), kTag, session.communicator().get(), &request),
        "MPI_Irecv");
  Backoff backoff(session.is_oversubscribed() ? Patience::yield_only : Patience::spin_first);
  for (int complete = 0;;) {
    check(MPI_Test(&request, &complete, MPI_STATUS_IGNORE), "MPI_Test");
    if (complete != 0) return value;
    backoff.wait();
  }
}

ClockOffset ask(const Session& session, Rank rank, const Stopwatch& clock) {
  std::array<ClockReading, kQuestions> readings;
  for (std::size_t i = 0; i != kQuestions; ++i) {
    const std::uint64_t asked_ns = clock.elapsed_ns();
    send(session, rank, i);
    const std::uint64_t read_ns = receive(session, rank);
    readings[i] = {asked_ns, read_ns, clock.elapsed_ns()};
  }
  return offset_from(readings);
}

void answer(const Session& session, const Stopwatch& clock) {
  for (std::size_t i = 0; i != kQuestions; ++i) {
    receive(session, kMasterRank);
    send(session, kMasterRank, clock.elapsed_ns());
  }
}

}  // namespace

std::vector<ClockOffset> measure_clock_offsets(const Session& session, const Stopwatch& clock) {
  if (session.rank() != kMasterRank) {
    answer(session, clock);
    return {};
  }
  std::vector<ClockOffset> offsets(session.size());
  for (Rank rank = 1; rank != session.size(); ++rank) offsets[rank] = ask(session, rank, clock);
  return offsets;
}

}  // namespace tessera::scheduler::mpi
