// SPDX-License-Identifier: BSD-3-Clause
// Nanoseconds of the Master state machine alone, from an event to its actions: results of ranks in random order, each
// answered by an assignment, with a million tasks queued all the time.
//   bench_master --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
#include "scheduler/master.h"

#include <benchmark/benchmark.h>

#include <array>
#include <optional>
#include <random>
#include <variant>
#include <vector>

namespace {

using namespace tessera::scheduler;

constexpr std::int64_t kResults = 1'000'000;
constexpr std::uint32_t kQueued = 1'000'000;
constexpr double kTaskSeconds = 1e-3;

/// A rank's tasks, oldest first. Ranks deliver in the order in which they were assigned.
class Held {
 public:
  void push(TaskId task) { ring_[last_++ % ring_.size()] = task; }
  TaskId pop() { return ring_[first_++ % ring_.size()]; }

 private:
  std::array<TaskId, 8> ring_{};
  std::uint32_t first_ = 0;
  std::uint32_t last_ = 0;
};

void take(const std::vector<Action>& actions, std::vector<Held>& held) {
  for (const Action& action : actions) {
    const Assign& assign = std::get<Assign>(action);
    for (const TaskRun& run : assign.runs) {
      for (std::uint32_t i = 0; i != run.count; ++i) held[assign.rank].push(TaskId{index_of(run.first) + i});
    }
  }
}

/// Everything that one measurement changes.
struct Setting {
  Setting(bool costs_known, std::uint32_t ranks) : held(ranks) {
    Plan plan;
    plan.tasks = kQueued + kResults + 8 * ranks;
    plan.role = MasterRole::dedicated;
    std::mt19937_64 random(1);
    if (costs_known) {
      plan.costs.resize(plan.tasks);
      for (double& cost : plan.costs) cost = static_cast<double>(random() % 1000);
    }
    master.emplace(plan, ranks);
    actions.reserve(ranks + 1);
    const std::vector<RunList> first = first_tasks(plan, ranks);
    for (Rank rank = 1; rank != ranks; ++rank) actions.push_back(Assign{rank, first[rank]});
    take(actions, held);
    for (std::int64_t i = 0; i != kResults; ++i) {
      senders.push_back(static_cast<Rank>(1 + random() % (ranks - 1)));
    }
  }

  std::optional<Master> master;
  std::vector<Held> held;
  std::vector<Rank> senders;
  std::vector<Action> actions;
};

void handle_result(benchmark::State& state, bool costs_known) {
  Setting setting(costs_known, static_cast<std::uint32_t>(state.range(0)));
  std::size_t sender = 0;
  for (auto _ : state) {
    const Rank rank = setting.senders[sender++];
    setting.actions.clear();
    const Verdict verdict =
        setting.master->handle(Result{rank, setting.held[rank].pop(), kTaskSeconds}, 0, setting.actions);
    if (verdict != Verdict::accepted) {
      state.SkipWithError("a result was refused");
      break;
    }
    take(setting.actions, setting.held);
  }
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK_CAPTURE(handle_result, in_order, false)
    ->Name("BM_HandleResult/in_order")
    ->Arg(16)
    ->Arg(4097)
    ->Iterations(kResults);
BENCHMARK_CAPTURE(handle_result, dearest_first, true)
    ->Name("BM_HandleResult/dearest_first")
    ->Arg(16)
    ->Arg(4097)
    ->Iterations(kResults);

}  // namespace
