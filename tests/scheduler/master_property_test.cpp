// SPDX-License-Identifier: BSD-3-Clause
// Thousands of random histories against a model that knows nothing of policies: who is there, who holds what, what is
// accepted. Whatever arrives, in whatever order, the master's promises hold.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <random>
#include <vector>

#include "scheduler/master.h"

namespace tessera::scheduler {
namespace {

enum class State { open, held, accepted };

class History {
 public:
  explicit History(std::uint64_t seed)
      : random_(seed), plan_(random_plan()), ranks_(1 + below(12)), master_(plan_, ranks_) {
    states_.assign(plan_.tasks, State::open);
    holders_.assign(plan_.tasks, 0);
    held_.resize(ranks_);
    present_.assign(ranks_, false);
    stopped_.assign(ranks_, false);
  }

  void play() {
    for (std::uint32_t steps = 0; !is_over(); ++steps) {
      BOOST_REQUIRE_MESSAGE(steps < 1000 * (plan_.tasks + ranks_), "the history does not end");
      const std::uint32_t dice = below(20);
      if (dice == 0) {
        send_bogus_result();
      } else if (dice == 1) {
        send_leave();
      } else if (dice < 6) {
        send_hello();
      } else {
        send_result();
      }
    }
    BOOST_TEST(dones_ == (plan_.tasks > 0 ? 1U : 0U));
    for (Rank rank = 1; rank < ranks_; ++rank) BOOST_TEST(stopped_[rank]);
    BOOST_TEST(!stopped_[kMasterRank]);
  }

 private:
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }

  Plan random_plan() {
    Plan plan;
    plan.policy = static_cast<Policy>(below(5));
    plan.tasks = below(4) == 0 ? below(3) : below(200);
    if (below(3) == 0) plan.prefetch = 1 + below(20);
    if (below(3) == 0) {
      for (std::uint32_t task = 0; task < plan.tasks; ++task) plan.costs.push_back(below(5));
    }
    return plan;
  }

  bool is_over() const {
    const bool workers_stopped = std::all_of(stopped_.begin() + 1, stopped_.end(), [](bool b) { return b; });
    return accepted_ == plan_.tasks && workers_stopped;
  }

  // The most that a rank may ever hold.
  std::uint32_t limit(Rank rank) const {
    if (rank == kMasterRank) return 1;
    const std::uint32_t longest_run = (plan_.tasks + ranks_ - 1) / ranks_;
    if (plan_.policy == Policy::guided) return plan_.prefetch.value_or(1) - 1 + longest_run;
    return plan_.prefetch.value_or(plan_.policy == Policy::self_scheduling ? 1 : 16);
  }

  void send_hello() {
    const Rank rank = below(ranks_);
    const bool expected = !present_[rank] && !stopped_[rank] && !(rank == kMasterRank && zero_is_finished_);
    send(Hello{rank}, expected ? Verdict::accepted : Verdict::duplicate, [&] {
      present_[rank] = true;
      if (accepted_ == plan_.tasks && rank == kMasterRank) zero_is_finished_ = true;
    });
  }

  void send_leave() {
    const Rank rank = below(ranks_);
    if (rank == kMasterRank && accepted_ == plan_.tasks) return;
    send(Leave{rank}, present_[rank] ? Verdict::accepted : Verdict::duplicate, [&] { present_[rank] = false; });
  }

  void send_result() {
    const Rank rank = below(ranks_);
    if (held_[rank].empty()) {
      // Where there is work left for it, a rank that is there always has some in hand.
      if (present_[rank] && !has_owners(plan_.policy)) BOOST_TEST(open() == 0U);
      return;
    }
    const std::size_t chosen = below(static_cast<std::uint32_t>(held_[rank].size()));
    const std::uint32_t task = held_[rank][chosen];
    send(Result{rank, TaskId{task}, below(2) == 0 ? 1e-6 : 1e-2}, Verdict::accepted, [&] {
      held_[rank].erase(held_[rank].begin() + static_cast<std::ptrdiff_t>(chosen));
      states_[task] = State::accepted;
      ++accepted_;
    });
  }

  void send_bogus_result() {
    const Rank rank = below(ranks_ + 2);
    const std::uint32_t task = below(plan_.tasks + 2);
    if (rank >= ranks_ || task >= plan_.tasks) {
      send(Result{rank, TaskId{task}, 1}, Verdict::unknown, [] {});
    } else if (states_[task] == State::accepted) {
      send(Result{rank, TaskId{task}, 1}, Verdict::duplicate, [] {});
    } else if (states_[task] == State::open || holders_[task] != rank) {
      send(Result{rank, TaskId{task}, 1}, Verdict::unassigned, [] {});
    }
  }

  // Tells the master, brings the model up to date, and holds what the master wants done against it.
  template <class Update>
  void send(const Event& event, Verdict expected, const Update& update) {
    actions_.clear();
    const Verdict verdict = master_.handle(event, actions_);
    BOOST_REQUIRE(verdict == expected);
    if (verdict != Verdict::accepted) {
      BOOST_REQUIRE(actions_.empty());
      return;
    }
    update();
    for (const Action& action : actions_) std::visit([&](const auto& wanted) { check(wanted); }, action);
    BOOST_REQUIRE(master_.is_done() == (accepted_ == plan_.tasks));
    BOOST_REQUIRE(dones_ == (master_.is_done() && plan_.tasks > 0 ? 1U : 0U));
    BOOST_REQUIRE(master_.accepted() == accepted_);
    for (Rank rank = 0; rank < ranks_; ++rank) BOOST_REQUIRE(master_.held_by(rank) == held_[rank].size());
    if (master_.is_done()) {
      for (Rank rank = 1; rank < ranks_; ++rank) BOOST_REQUIRE(!present_[rank]);
      if (present_[kMasterRank]) zero_is_finished_ = true;
    }
  }

  void check(const Assign& assign) {
    BOOST_REQUIRE(present_[assign.rank]);
    BOOST_REQUIRE(!assign.runs.empty());
    for (const TaskRun& run : assign.runs) {
      BOOST_REQUIRE(run.count > 0);
      for (std::uint32_t i = 0; i < run.count; ++i) {
        const std::uint32_t task = index_of(run.first) + i;
        BOOST_REQUIRE(task < plan_.tasks);
        BOOST_REQUIRE((states_[task] == State::open));
        if (has_owners(plan_.policy)) BOOST_REQUIRE(task % ranks_ == assign.rank);
        states_[task] = State::held;
        holders_[task] = assign.rank;
        held_[assign.rank].push_back(task);
      }
    }
    BOOST_REQUIRE_LE(held_[assign.rank].size(), limit(assign.rank));
  }

  void check(const Stop& stop) {
    BOOST_REQUIRE(accepted_ == plan_.tasks);
    BOOST_REQUIRE(stop.rank != kMasterRank);
    BOOST_REQUIRE(present_[stop.rank]);
    BOOST_REQUIRE(!stopped_[stop.rank]);
    present_[stop.rank] = false;
    stopped_[stop.rank] = true;
  }

  void check(const Done&) {
    BOOST_REQUIRE(accepted_ == plan_.tasks);
    ++dones_;
  }

  std::size_t open() const { return static_cast<std::size_t>(std::count(states_.begin(), states_.end(), State::open)); }

  std::mt19937_64 random_;
  Plan plan_;
  std::uint32_t ranks_;
  Master master_;
  std::vector<Action> actions_;
  std::vector<State> states_;                     // per task
  std::vector<Rank> holders_;                     // per task
  std::vector<std::vector<std::uint32_t>> held_;  // per rank
  std::vector<bool> present_;
  std::vector<bool> stopped_;
  bool zero_is_finished_ = false;  // rank 0 gets no stop but says no second hello after the end either
  std::uint32_t accepted_ = 0;
  std::uint32_t dones_ = 0;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(master_property)

BOOST_AUTO_TEST_CASE(no_history_breaks_a_promise) {
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    BOOST_TEST_CONTEXT("seed " << seed) {
      History(seed).play();
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
