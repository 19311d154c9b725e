// SPDX-License-Identifier: BSD-3-Clause
// Microseconds that rank 0 spends on a tile, with real messages and tiles that take no time to render. Rank 0 does
// nothing but schedule; the other ranks send results of a given size as fast as they get tasks.
//   mpirun -n 2 bench_master_cost [TASKS [ROUNDS]]
//
//   makespan   of the run, by its tasks
//   rank 0     its own part of that: without the looks that find no message, and what it does till the next one
//   behind     the same where it pauses after such a look, so that results pile up as they do where rank 0 is what
//              everybody waits for
//
// Every round measures every size once; printed are medians over the rounds, and (max - min) / median.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <thread>
#include <vector>

#include "scheduler/mpi/session.h"
#include "scheduler/mpi/transport.h"
#include "scheduler/run.h"
#include "scheduler/stopwatch.h"

namespace {

using namespace tessera::scheduler;

constexpr std::array<std::size_t, 5> kPayloads{0, 64, 768, 3072, 12288};

/// Enough for a rank to send all the results that it may hold.
constexpr std::chrono::microseconds kPause{100};

/// Passes messages on and takes the time that a rank has nothing to do: from a look that finds no message to the next
/// look.
class WatchedTransport final : public Transport {
 public:
  WatchedTransport(Transport& carrier, std::chrono::microseconds pause) : carrier_(carrier), pause_(pause) {}

  Rank rank() const noexcept override { return carrier_.rank(); }
  std::uint32_t size() const noexcept override { return carrier_.size(); }
  bool try_flush() override { return carrier_.try_flush(); }
  void abandon(Rank rank) override { carrier_.abandon(rank); }
  bool is_oversubscribed() const noexcept override { return carrier_.is_oversubscribed(); }

  /// units:   seconds
  double idle_s() const noexcept { return seconds_from_ns(idle_ns_); }

 private:
  void do_send(Rank to, std::span<const std::byte> head, std::span<const std::byte> rest) override {
    carrier_.send(to, head, rest);
  }

  std::optional<Envelope> do_receive() override {
    // A look that finds nothing counts as idle as well, so its beginning is what matters.
    const std::uint64_t begin_ns = clock_.elapsed_ns();
    if (found_nothing_) idle_ns_ += begin_ns - look_ns_;
    look_ns_ = begin_ns;
    std::optional<Envelope> envelope = carrier_.receive();
    found_nothing_ = !envelope;
    if (found_nothing_ && pause_.count() > 0) std::this_thread::sleep_for(pause_);
    return envelope;
  }

  Transport& carrier_;
  std::chrono::microseconds pause_;
  Stopwatch clock_;
  std::uint64_t look_ns_ = 0;
  std::uint64_t idle_ns_ = 0;
  bool found_nothing_ = false;
};

/// units:   microseconds per task
struct Cost {
  double makespan = 0;
  double rank0 = 0;
};

Cost measure(mpi::Session& session, std::uint32_t tasks, std::size_t payload, std::chrono::microseconds pause) {
  mpi::MpiTransport carrier(session);
  const Work work = [&](TaskId, const auto&) { return Bytes(payload, std::byte{1}); };
  session.barrier();
  Plan plan;
  plan.tasks = tasks;
  plan.role = MasterRole::dedicated;
  if (session.rank() != kMasterRank) {
    run_worker(carrier, plan, work);
    session.barrier();
    return {};
  }
  WatchedTransport transport(carrier, pause);
  std::array<std::byte, kPayloads.back()> picture{};
  const RunRecord run = run_master(transport, plan, work, [&](TaskId, std::span<const std::byte> bytes) {
    if (!bytes.empty()) std::memcpy(picture.data(), bytes.data(), bytes.size());
  });
  session.barrier();
  return {run.makespan_s * 1e6 / tasks, (run.makespan_s - transport.idle_s()) * 1e6 / tasks};
}

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// "1.23  4%"
void print(std::vector<double>& values) {
  const double middle = median(values);
  std::printf("  %12.2f %6.0f%%", middle, 100 * (values.back() - values.front()) / middle);
}

void measure_all(mpi::Session& session, std::uint32_t tasks, int rounds) {
  using Samples = std::array<std::vector<double>, kPayloads.size()>;
  Samples makespans;
  Samples in_step;
  Samples behind;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < kPayloads.size(); ++i) {
      const Cost cost = measure(session, tasks, kPayloads[i], {});
      makespans[i].push_back(cost.makespan);
      in_step[i].push_back(cost.rank0);
      behind[i].push_back(measure(session, tasks, kPayloads[i], kPause).rank0);
    }
  }
  if (session.rank() != kMasterRank) return;
  std::printf("%u ranks, %u tasks, %d rounds, us per task\n", session.size(), tasks, rounds);
  std::printf("payload       makespan  spread         rank 0  spread         behind  spread\n");
  for (std::size_t i = 0; i < kPayloads.size(); ++i) {
    std::printf("%7zu", kPayloads[i]);
    for (Samples* samples : {&makespans, &in_step, &behind}) print((*samples)[i]);
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  mpi::Session session(argc, argv);
  try {
    const auto tasks = static_cast<std::uint32_t>(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 200'000);
    const auto rounds = static_cast<int>(argc > 2 ? std::strtol(argv[2], nullptr, 10) : 5);
    if (session.size() < 2 || tasks == 0 || rounds < 1) {
      std::fprintf(stderr, "bench_master_cost: needs 2 ranks or more, and tasks and rounds above 0\n");
      session.abort(64);
    }
    measure_all(session, tasks, rounds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_master_cost: rank %u: %s\n", session.rank(), error.what());
    session.abort(70);
  }
}
