// SPDX-License-Identifier: BSD-3-Clause
// Whole runs in one process in which workers die between two steps or in the middle of a task, stand still for several
// leases, and deliver broken results. What is accepted is complete and right. Nothing is asserted about time: on a slow
// machine more ranks are taken for lost, and the results are the same.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "scheduler/all_policies.h"
#include "scheduler/loopback.h"
#include "scheduler/master_run.h"
#include "scheduler/message.h"
#include "scheduler/worker_run.h"

namespace tessera::scheduler {
namespace {

constexpr double kLeaseSeconds = 2e-3;
constexpr double kFarTooLongSeconds = 30;

Bytes payload_of(TaskId task) {
  return Bytes(1 + index_of(task) % 37, static_cast<std::byte>(index_of(task) * 7 + 1));
}

// Thrown through a task in the middle of which its rank dies.
struct Dies {};

// Breaks some of the results on their way to rank 0: a bit, but not of the kind.
class BreakingTransport final : public Transport {
 public:
  BreakingTransport(Transport& sound, std::uint64_t seed, std::uint32_t one_in)
      : sound_(sound), random_(seed), one_in_(one_in) {}

  Rank rank() const noexcept override { return sound_.rank(); }
  std::uint32_t size() const noexcept override { return sound_.size(); }
  bool try_flush() override { return sound_.try_flush(); }
  void abandon(Rank rank) override { sound_.abandon(rank); }
  bool is_oversubscribed() const noexcept override { return sound_.is_oversubscribed(); }
  std::uint64_t broken() const noexcept { return broken_; }

 private:
  void do_send(Rank to, std::span<const std::byte> head, std::span<const std::byte> rest) override {
    Bytes message(head.begin(), head.end());
    message.insert(message.end(), rest.begin(), rest.end());
    const bool is_result = std::holds_alternative<ResultMessage>(decode(message));
    if (is_result && one_in_ > 0 && random_() % one_in_ == 0) {
      const std::size_t bit = 32 + random_() % (8 * message.size() - 32);
      message[bit / 8] ^= std::byte{static_cast<unsigned char>(1U << (bit % 8))};
      ++broken_;
    }
    sound_.send(to, message);
  }
  std::optional<Envelope> do_receive() override { return sound_.receive(); }

  Transport& sound_;
  std::mt19937_64 random_;
  std::uint32_t one_in_;
  std::uint64_t broken_ = 0;
};

struct Fate {
  std::uint64_t dies_at_step = ~std::uint64_t{0};   ///< no step after that
  std::uint64_t dies_at_slice = ~std::uint64_t{0};  ///< in the middle of a task
  std::uint64_t stalls_at_step = ~std::uint64_t{0};
  double stalls_for_s = 0;
};

// A rank that takes steps until its fate comes.
class FatedWorker {
 public:
  FatedWorker(Transport& transport, const Plan& plan, const Fate& fate, std::uint64_t seed, std::uint32_t breaks_one_in)
      : fate_(fate),
        transport_(transport, seed, breaks_one_in),
        run_(transport_, plan, [this](TaskId task, const auto& between_slices) { return work(task, between_slices); }) {
  }

  void step() {
    if (is_dead_ || is_home_) return;
    const std::uint64_t step = steps_++;
    if (step == fate_.dies_at_step) is_dead_ = true;
    if (step == fate_.stalls_at_step) stall_.emplace();
    if (stall_ && stall_->seconds() > fate_.stalls_for_s) stall_.reset();
    if (is_dead_ || stall_) return;
    try {
      is_home_ = run_.step() == Step::finished;
    } catch (const Dies&) {
      is_dead_ = true;
    }
  }

  void wake() { stall_.reset(); }
  bool is_dead() const noexcept { return is_dead_; }
  bool is_home() const noexcept { return is_home_; }
  std::uint64_t broken() const noexcept { return transport_.broken(); }

 private:
  Bytes work(TaskId task, const std::function<void()>& between_slices) {
    for (std::uint32_t slice = 0; slice < index_of(task) % 4; ++slice) {
      if (slices_++ == fate_.dies_at_slice) throw Dies{};
      between_slices();
    }
    return payload_of(task);
  }

  Fate fate_;
  BreakingTransport transport_;
  WorkerRun run_;
  std::uint64_t steps_ = 0;
  std::uint64_t slices_ = 0;
  std::optional<Stopwatch> stall_;
  bool is_dead_ = false;
  bool is_home_ = false;
};

struct Misfortunes {
  std::uint32_t dies_one_in = 0;
  std::uint32_t stalls_one_in = 0;
  std::uint32_t breaks_one_in = 0;
};

class FaultyRun {
 public:
  FaultyRun(std::uint64_t seed, const Plan& plan, std::uint32_t ranks, const Misfortunes& misfortunes)
      : random_(seed), network_(ranks, random_()), times_(plan.tasks, 0) {
    for (Rank rank = 1; rank < ranks; ++rank) {
      workers_.push_back(std::make_unique<FatedWorker>(network_.transport(rank), plan, random_fate(misfortunes),
                                                       random_(), misfortunes.breaks_one_in));
    }
    const Work own_work = [](TaskId task, const auto& between_slices) {
      between_slices();
      return payload_of(task);
    };
    const Accept accept = [this](TaskId task, std::span<const std::byte> payload) {
      ++times_.at(index_of(task));
      const Bytes expected = payload_of(task);
      BOOST_TEST(std::equal(payload.begin(), payload.end(), expected.begin(), expected.end()));
    };
    master_ = std::make_unique<MasterRun>(network_.transport(kMasterRank), plan, own_work, accept);
  }

  RunRecord play() {
    const Stopwatch clock;
    for (Step step = Step::idle; step != Step::finished;) {
      BOOST_REQUIRE_MESSAGE(clock.seconds() < kFarTooLongSeconds, "it does not end");
      const std::size_t chosen = random_() % (workers_.size() + 1);
      if (chosen < workers_.size()) {
        workers_[chosen]->step();
      } else {
        step = master_->step();
      }
    }
    for (const int count : times_) BOOST_TEST(count == 1);
    RunRecord run = master_->take_record();
    for (const auto& worker : workers_) {
      const Rank rank = static_cast<Rank>(1 + (&worker - workers_.data()));
      const bool is_lost =
          std::any_of(run.lost.begin(), run.lost.end(), [&](const LostRank& lost) { return lost.rank == rank; });
      if (worker->is_dead()) BOOST_TEST(is_lost, "rank " << rank << " died and nobody noticed");
      if (!worker->is_dead() && !worker->is_home()) BOOST_TEST(is_lost, "rank " << rank << " was left behind");
      broken_ += worker->broken();
      if (worker->is_dead()) ++died_;
      // Who wakes up after the end finds its way home
      worker->wake();
      for (int steps = 0; !worker->is_dead() && !worker->is_home(); ++steps) {
        BOOST_REQUIRE_MESSAGE(steps < 100000, "rank " << rank << " does not find home");
        worker->step();
        worker->wake();
      }
    }
    return run;
  }

  std::uint64_t broken() const noexcept { return broken_; }
  std::uint32_t died() const noexcept { return died_; }

 private:
  Fate random_fate(const Misfortunes& misfortunes) {
    Fate fate;
    if (misfortunes.dies_one_in > 0 && random_() % misfortunes.dies_one_in == 0) {
      (random_() % 2 == 0 ? fate.dies_at_step : fate.dies_at_slice) = random_() % 40;
    }
    if (misfortunes.stalls_one_in > 0 && random_() % misfortunes.stalls_one_in == 0) {
      fate.stalls_at_step = random_() % 40;
      fate.stalls_for_s = kLeaseSeconds * static_cast<double>(random_() % 400) / 100;
    }
    return fate;
  }

  std::mt19937_64 random_;
  LoopbackNetwork network_;
  std::vector<int> times_;
  std::vector<std::unique_ptr<FatedWorker>> workers_;
  std::unique_ptr<MasterRun> master_;
  std::uint64_t broken_ = 0;
  std::uint32_t died_ = 0;
};

Plan random_plan(std::uint64_t seed) {
  Plan plan;
  plan.policy = kAllPolicies[seed % std::size(kAllPolicies)];
  plan.tasks = static_cast<std::uint32_t>(seed * 17 % 150);
  if (seed % 3 == 0) plan.prefetch = static_cast<unsigned>(1 + seed % 9);
  if (seed % 4 == 0 && !has_owners(plan.policy)) plan.role = MasterRole::dedicated;
  plan.lease_s = kLeaseSeconds;
  return plan;
}

struct Totals {
  std::uint64_t died = 0;
  std::uint64_t broken = 0;
  Faults faults;
};

Totals play_all(std::uint64_t runs, const Misfortunes& misfortunes) {
  Totals totals;
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    BOOST_TEST_CONTEXT("seed " << seed) {
      FaultyRun faulty(seed, random_plan(seed), static_cast<std::uint32_t>(2 + seed % 5), misfortunes);
      const RunRecord run = faulty.play();
      totals.died += faulty.died();
      totals.broken += faulty.broken();
      totals.faults.damaged += run.faults.damaged;
      totals.faults.silences += run.faults.silences;
      totals.faults.late += run.faults.late;
      BOOST_TEST(run.faults.damaged <= faulty.broken());
    }
  }
  return totals;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(faulty_run)

BOOST_AUTO_TEST_CASE(nothing_is_lost_where_workers_die) {
  const Totals totals = play_all(150, {.dies_one_in = 2});
  BOOST_TEST(totals.died > 50U);
  BOOST_TEST(totals.faults.silences > 0U);
}

BOOST_AUTO_TEST_CASE(nothing_is_lost_where_all_workers_die) {
  const Totals totals = play_all(60, {.dies_one_in = 1});
  BOOST_TEST(totals.died > 60U);
}

BOOST_AUTO_TEST_CASE(nothing_is_done_twice_where_workers_stand_still) {
  const Totals totals = play_all(150, {.stalls_one_in = 2});
  BOOST_TEST(totals.died == 0U);
  BOOST_TEST(totals.faults.silences > 0U);
}

BOOST_AUTO_TEST_CASE(nothing_broken_is_accepted) {
  const Totals totals = play_all(150, {.breaks_one_in = 8});
  BOOST_TEST(totals.broken > 0U);
  BOOST_TEST(totals.faults.damaged > 0U);
}

BOOST_AUTO_TEST_CASE(all_of_it_at_once_changes_no_result) {
  play_all(200, {.dies_one_in = 4, .stalls_one_in = 3, .breaks_one_in = 20});
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
