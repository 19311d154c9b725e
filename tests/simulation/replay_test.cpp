// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/replay.h"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "scheduler/run.h"

namespace tessera::simulation {
namespace {

using scheduler::Bytes;
using scheduler::TaskId;

const std::vector<CostMap::Cost> kCosts{{0.25, 100}, {1, 2}, {0, 0}};

}  // namespace

BOOST_AUTO_TEST_SUITE(replay_work)

BOOST_AUTO_TEST_CASE(a_task_spends_its_cost_in_slices) {
  std::vector<double> spent;
  int looks = 0;
  const scheduler::Work work = replay(kCosts, 0.3, [&](double seconds) { spent.push_back(seconds); });
  work(TaskId{1}, [&] { ++looks; });
  BOOST_TEST(spent.size() == 4U);
  double sum = 0;
  for (const double seconds : spent) {
    BOOST_TEST(seconds <= 0.3);
    sum += seconds;
  }
  BOOST_TEST(sum == 1, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(looks == 4);
}

BOOST_AUTO_TEST_CASE(a_task_delivers_its_size) {
  const scheduler::Work work = replay(kCosts, 1, [](double) {});
  for (std::uint32_t task = 0; task != kCosts.size(); ++task) {
    BOOST_TEST(work(TaskId{task}, [] {}).size() == kCosts[task].bytes);
  }
}

BOOST_AUTO_TEST_CASE(a_slice_that_takes_no_time_is_refused) {
  BOOST_CHECK_THROW(replay(kCosts, 0, [](double) {}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_run_in_process_is_complete) {
  Collection collection(kCosts);
  const auto accept = [&](TaskId task, auto delivered) { collection.accept(task, delivered); };
  run_in_process(3, 1, {.tasks = 3, .costs = {}, .prefetch = {}}, replay(kCosts, 1, [](double) {}), accept);
  BOOST_TEST(collection.is_complete());
}

BOOST_AUTO_TEST_CASE(a_collection_misses_what_did_not_come_or_came_twice) {
  const scheduler::Work work = replay(kCosts, 1, [](double) {});
  Collection collection(kCosts);
  collection.accept(TaskId{0}, work(TaskId{0}, [] {}));
  collection.accept(TaskId{1}, work(TaskId{1}, [] {}));
  BOOST_TEST(!collection.is_complete());
  collection.accept(TaskId{2}, work(TaskId{2}, [] {}));
  BOOST_TEST(collection.is_complete());
  collection.accept(TaskId{2}, work(TaskId{2}, [] {}));
  BOOST_TEST(!collection.is_complete());
}

BOOST_AUTO_TEST_CASE(a_collection_refuses_another_tasks_result) {
  const std::vector<CostMap::Cost> same{{1, 100}, {1, 100}};
  Collection collection(same);
  const scheduler::Work work = replay(same, 1, [](double) {});
  BOOST_CHECK_THROW(collection.accept(TaskId{1}, work(TaskId{0}, [] {})), std::runtime_error);
  BOOST_CHECK_THROW(collection.accept(TaskId{0}, Bytes(99)), std::runtime_error);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::simulation
