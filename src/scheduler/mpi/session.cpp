// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/session.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "scheduler/backoff.h"
#include "scheduler/mpi/check.h"
#include "scheduler/mpi/communicator.h"

namespace tessera::scheduler::mpi {
namespace {

constexpr int kInternalError = 70;  // EX_SOFTWARE of sysexits.h
constexpr unsigned kSecondsToFinalize = 2;

void initialize(int& argc, char**& argv) {
  // On an oversubscribed node Open MPI gives the core away at every look at the mail that finds none, between the
  // slices of a task too. Waiting gives it away here, see Backoff; working must not.
  ::setenv("OMPI_MCA_mpi_yield_when_idle", "0", 0);

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

std::uint32_t count_nodes(const Communicator& job, bool is_first_on_node) {
  const int first_on_node = is_first_on_node ? 1 : 0;
  int nodes = 0;
  check(MPI_Allreduce(&first_on_node, &nodes, 1, MPI_INT, MPI_SUM, job.get()), "MPI_Allreduce");
  return static_cast<std::uint32_t>(nodes);
}

static_assert(sizeof(CoreSet) == sizeof(cpu_set_t));

CoreSet cores_of_thread() noexcept {
  CoreSet cores{};
  // More cores than fit the set: enough
  if (sched_getaffinity(0, sizeof cores, reinterpret_cast<cpu_set_t*>(cores.data())) != 0) cores.fill(~0UL);
  return cores;
}

void run_thread_on(const CoreSet& cores) noexcept {
  // Where the system refuses, the thread stays where it is
  sched_setaffinity(0, sizeof cores, reinterpret_cast<const cpu_set_t*>(cores.data()));
}

std::uint32_t count(const CoreSet& cores) noexcept {
  int sum = 0;
  for (const unsigned long word : cores) sum += std::popcount(word);
  return static_cast<std::uint32_t>(sum);
}

/// The cores that any rank of a node may run on. Launchers bind ranks to single cores or leave them free, so the union
/// is what counts.
CoreSet cores_of(const Communicator& node) {
  const CoreSet mine = cores_of_thread();
  CoreSet all{};
  check(MPI_Allreduce(mine.data(), all.data(), static_cast<int>(all.size()), MPI_UNSIGNED_LONG, MPI_BOR, node.get()),
        "MPI_Allreduce");
  return all;
}

/// The first rank's bytes to all of a communicator.
void broadcast_among(const Communicator& ranks, std::span<std::byte> bytes, std::size_t piece_bytes,
                     Patience patience) {
  if (piece_bytes == 0 || piece_bytes > std::size_t{std::numeric_limits<int>::max()}) {
    throw std::invalid_argument("a piece of a broadcast must have 1 ... 2^31 - 1 bytes");
  }
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(piece_bytes, bytes.size()))) {
    MPI_Request request = MPI_REQUEST_NULL;
    const auto count = static_cast<int>(std::min(piece_bytes, bytes.size()));
    check(MPI_Ibcast(bytes.data(), count, MPI_BYTE, 0, ranks.get(), &request), "MPI_Ibcast");
    wait(request, patience);
  }
}

}  // namespace

Session::Session(int& argc, char**& argv, std::uint32_t most_on_node) : exceptions_before_(std::uncaught_exceptions()) {
  initialize(argc, argv);
  communicator_ = std::make_unique<Communicator>(Communicator::of_job());
  rank_ = static_cast<Rank>(communicator_->rank());
  size_ = static_cast<std::uint32_t>(communicator_->size());
  const Communicator machine = Communicator::of_node(*communicator_);
  node_cores_ = cores_of(machine);
  oversubscribed_ = static_cast<std::uint32_t>(machine.size()) > count(node_cores_);

  const auto part = static_cast<std::uint32_t>(machine.rank()) / most_on_node;
  node_ = std::make_unique<Communicator>(Communicator::of_part(machine, static_cast<int>(part)));
  ranks_on_node_ = static_cast<std::uint32_t>(node_->size());
  first_on_node_ = node_->rank() == 0;
  auto alike = Communicator::of_part(*communicator_, first_on_node_ ? 0 : 1);
  if (first_on_node_) first_ranks_ = std::make_unique<Communicator>(std::move(alike));
  nodes_ = count_nodes(*communicator_, first_on_node_);
}

Session::~Session() {
  if (std::uncaught_exceptions() > exceptions_before_) abort(kInternalError);
  if (rank_is_lost_) {
    // Every file is written by now.
    std::fflush(nullptr);
    std::signal(SIGALRM, [](int) { std::_Exit(0); });
    ::alarm(kSecondsToFinalize);
  }
  first_ranks_.reset();
  node_.reset();
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
  wait(request, patience());
}

void Session::broadcast(Bytes& bytes, std::size_t piece_bytes) {
  std::uint64_t size = bytes.size();
  broadcast(std::as_writable_bytes(std::span(&size, 1)), piece_bytes);
  if (rank_ != kMasterRank) bytes.resize(size);
  broadcast(std::span(bytes), piece_bytes);
}

void Session::broadcast(std::span<std::byte> bytes, std::size_t piece_bytes) {
  broadcast_among(*communicator_, bytes, piece_bytes, patience());
}

void Session::broadcast_to_nodes(std::span<std::byte> bytes, std::size_t piece_bytes) {
  if (first_ranks_) broadcast_among(*first_ranks_, bytes, piece_bytes, patience());
}

void Session::broadcast_on_node(std::span<std::byte> bytes, std::size_t piece_bytes) {
  broadcast_among(*node_, bytes, piece_bytes, patience());
}

bool Session::do_all_on_node(bool yes) {
  const int mine = yes ? 1 : 0;
  int all = 0;
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Iallreduce(&mine, &all, 1, MPI_INT, MPI_MIN, node_->get(), &request), "MPI_Iallreduce");
  wait(request, patience());
  return all == 1;
}

void Session::abort(int code) noexcept {
  std::fflush(nullptr);
  MPI_Abort(MPI_COMM_WORLD, code);
  std::_Exit(code);
}

NodeCores::NodeCores(const Session& session) noexcept
    : before_(cores_of_thread()), threads_(std::min(session.ranks_on_node_, std::max(1U, count(session.node_cores_)))) {
  run_thread_on(session.node_cores_);
}

NodeCores::~NodeCores() {
  run_thread_on(before_);
}

}  // namespace tessera::scheduler::mpi
