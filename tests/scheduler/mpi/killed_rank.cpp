// SPDX-License-Identifier: BSD-3-Clause
// A rank is killed in the middle of a large message to rank 0. Rank 0 must get every message of the others, get past
// what it sent to the dead one, and say so. Needs 3 ranks and mpirun --enable-recovery.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "scheduler/mpi/session.h"
#include "scheduler/mpi/transport.h"

namespace {

using namespace tessera::scheduler;

constexpr Rank kLiving = 1;
constexpr Rank kDying = 2;
constexpr std::uint32_t kMessages = 200;
constexpr std::size_t kLargeBytes = 20'000'000;

void die(Transport& transport) {
  transport.send(kMasterRank, Bytes(kLargeBytes));
  transport.send(kMasterRank, Bytes(kLargeBytes));
  // Long enough for the first pieces to be on their way
  for (int i = 0; i != 3; ++i) static_cast<void>(transport.try_flush());
  std::raise(SIGKILL);
}

void send_all(Transport& transport) {
  for (std::uint32_t i = 0; i != kMessages; ++i) {
    transport.send(kMasterRank, Bytes(i % 2 == 0 ? 10 : 100'000));
    static_cast<void>(transport.try_flush());
  }
  transport.flush();
}

void receive_all(Transport& transport) {
  Backoff backoff(transport.patience());
  for (std::uint32_t arrived = 0; arrived != kMessages;) {
    const auto envelope = transport.receive();
    if (!envelope) {
      backoff.wait();
      continue;
    }
    backoff.reset();
    arrived += envelope->source == kLiving ? 1U : 0U;
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  transport.send(kDying, Bytes(kLargeBytes));
  const bool is_stuck = !transport.try_flush();
  transport.abandon(kDying);
  transport.flush();
  if (is_stuck) std::puts("nobody waited for the dead rank");
}

}  // namespace

int main(int argc, char** argv) {
  mpi::Session session(argc, argv);
  mpi::MpiTransport transport(session);
  if (session.rank() == kDying) die(transport);
  if (session.rank() == kLiving) send_all(transport);
  if (session.rank() == kMasterRank) receive_all(transport);
  // Once a rank has died, MPI_Finalize does not always return (Open MPI 4.1.4 waits for the dead one now and then)
  if (session.rank() == kMasterRank) session.abort(0);
  for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}
