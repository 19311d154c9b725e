// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/session.h"

#include <sched.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "scheduler/backoff.h"
#include "scheduler/mpi/check.h"
#include "scheduler/mpi/communicator.h"

namespace tessera::scheduler::mpi {
namespace {

constexpr int kInternalError = 70;  // EX_SOFTWARE of sysexits.h

void initialize(int& argc, char**& argv) {
  // Only the thread that initialises calls MPI, but there may be others.
  int provided = MPI_THREAD_SINGLE;
  check(MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
  if (provided < MPI_THREAD_FUNNELED) {
    throw std::runtime_error("MPI does not allow threads besides the one that calls it (it provides level " +
                             std::to_string(provided) + ") use a library built with threads");
  }
}

/// Waits for a collective without burning the core.
void wait(MPI_Request request, Patience patience) {
  Backoff backoff(patience);
  for (int complete = 0;;) {
    check(MPI_Test(&request, &complete, MPI_STATUS_IGNORE), "MPI_Test");
    if (complete != 0) return;
    backoff.wait();
  }
}

std::uint32_t count_nodes(const Communicator& job, const Communicator& node) {
  const int first_on_node = node.rank() == 0 ? 1 : 0;
  int nodes = 0;
  check(MPI_Allreduce(&first_on_node, &nodes, 1, MPI_INT, MPI_SUM, job.get()), "MPI_Allreduce");
  return static_cast<std::uint32_t>(nodes);
}

/// Whether the ranks of a node outnumber the cores that any of them may run on. Launchers bind ranks to single cores or
/// leave them free, so the union of what they may use is what counts.
bool outnumber_cores(const Communicator& node) {
  using Word = unsigned long;
  std::array<Word, sizeof(cpu_set_t) / sizeof(Word)> mine{};
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  const bool known = sched_getaffinity(0, sizeof allowed, &allowed) == 0;
  if (!known) std::memset(&allowed, 0xff, sizeof allowed);  // more cores than fit the set: enough
  std::memcpy(mine.data(), &allowed, sizeof allowed);
  std::array<Word, mine.size()> all{};
  check(MPI_Allreduce(mine.data(), all.data(), static_cast<int>(all.size()), MPI_UNSIGNED_LONG, MPI_BOR, node.get()),
        "MPI_Allreduce");
  std::memcpy(&allowed, all.data(), sizeof allowed);
  return node.size() > CPU_COUNT(&allowed);
}

}  // namespace

Session::Session(int& argc, char**& argv) : exceptions_before_(std::uncaught_exceptions()) {
  initialize(argc, argv);
  communicator_ = std::make_unique<Communicator>(Communicator::of_job());
  rank_ = static_cast<Rank>(communicator_->rank());
  size_ = static_cast<std::uint32_t>(communicator_->size());
  const Communicator node = Communicator::of_node(*communicator_);
  nodes_ = count_nodes(*communicator_, node);
  oversubscribed_ = outnumber_cores(node);
}

Session::~Session() {
  if (std::uncaught_exceptions() > exceptions_before_) abort(kInternalError);
  communicator_.reset();
  MPI_Finalize();
}

std::string Session::library() const {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> words{};
  int length = 0;
  check(MPI_Get_library_version(words.data(), &length), "MPI_Get_library_version");
  const std::string_view all(words.data(), static_cast<std::size_t>(length));
  return std::string(all.substr(0, all.find_first_of(",\n")));
}

void Session::barrier() {
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Ibarrier(communicator_->get(), &request), "MPI_Ibarrier");
  wait(request, oversubscribed_ ? Patience::yield_only : Patience::spin_first);
}

void Session::broadcast(Bytes& bytes, std::size_t piece_bytes) {
  if (piece_bytes == 0 || piece_bytes > std::size_t{std::numeric_limits<int>::max()}) {
    throw std::invalid_argument("a piece of a broadcast must have 1 ... 2^31 - 1 bytes");
  }
  const auto patience = oversubscribed_ ? Patience::yield_only : Patience::spin_first;
  const auto broadcast_from_master = [&](void* data, std::size_t count, MPI_Datatype type) {
    MPI_Request request = MPI_REQUEST_NULL;
    check(
        MPI_Ibcast(data, static_cast<int>(count), type, static_cast<int>(kMasterRank), communicator_->get(), &request),
        "MPI_Ibcast");
    wait(request, patience);
  };

  std::uint64_t size = bytes.size();
  broadcast_from_master(&size, 1, MPI_UINT64_T);
  if (rank_ != kMasterRank) bytes.resize(size);
  for (std::size_t begin = 0; begin < size; begin += piece_bytes) {
    broadcast_from_master(bytes.data() + begin, std::min(piece_bytes, size - begin), MPI_BYTE);
  }
}

void Session::abort(int code) noexcept {
  std::fflush(nullptr);
  MPI_Abort(MPI_COMM_WORLD, code);
  std::_Exit(code);
}

}  // namespace tessera::scheduler::mpi
