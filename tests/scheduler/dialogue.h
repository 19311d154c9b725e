// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <vector>

#include "scheduler/master.h"

// A master in conversation with a test, which is every rank and the clock.
namespace tessera::scheduler {

inline Plan plan_of(Policy policy, std::uint32_t tasks) {
  Plan plan;
  plan.policy = policy;
  plan.tasks = tasks;
  return plan;
}

inline RunList one_run(std::uint32_t first, std::uint32_t count) {
  RunList runs;
  runs.push(TaskRun{TaskId{first}, count});
  return runs;
}

/// The lease is one second.
struct Dialogue {
  Dialogue(const Plan& plan, std::uint32_t ranks) : master(plan, ranks) {}
  Dialogue(Policy policy, std::uint32_t tasks, std::uint32_t ranks) : master(plan_of(policy, tasks), ranks) {}

  Verdict say(const Event& event) {
    actions.clear();
    return master.handle(event, now_s, actions);
  }

  /// Lets time pass, in steps that are short against a lease.
  void wait(double seconds) {
    constexpr int kSteps = 16;
    const double start_s = now_s;
    for (int step = 1; step <= kSteps; ++step) {
      now_s = start_s + seconds * step / kSteps;
      std::vector<Action> more;
      BOOST_TEST((master.handle(Tick{}, now_s, more) == Verdict::accepted));
      while_waiting.insert(while_waiting.end(), more.begin(), more.end());
    }
  }

  /// What the only action assigned to `rank`.
  RunList assigned_to(Rank rank) const {
    BOOST_REQUIRE_EQUAL(actions.size(), 1U);
    const auto& assign = std::get<Assign>(actions[0]);
    BOOST_REQUIRE_EQUAL(assign.rank, rank);
    return assign.runs;
  }

  /// How many actions of a kind there are.
  template <class Wanted>
  std::size_t count(const std::vector<Action>& among) const {
    return static_cast<std::size_t>(std::count_if(
        among.begin(), among.end(), [](const Action& action) { return std::holds_alternative<Wanted>(action); }));
  }

  Master master;
  double now_s = 0;
  std::vector<Action> actions;        ///< that followed from what was said last
  std::vector<Action> while_waiting;  ///< that followed from time alone, until a test clears them
};

}  // namespace tessera::scheduler
