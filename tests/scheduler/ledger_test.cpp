// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/ledger.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <optional>
#include <random>
#include <vector>

namespace tessera::scheduler {
namespace {

std::vector<std::uint32_t> numbers_of(std::vector<TaskId> tasks) {
  std::vector<std::uint32_t> numbers;
  for (const TaskId task : tasks) numbers.push_back(index_of(task));
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

// Task 3 was with rank 1, which fell silent, and is with rank 2 now.
Ledger reissued() {
  Ledger ledger(5, 4);
  ledger.assign({TaskId{3}, 1}, 1);
  ledger.reopen_held_by(1);
  ledger.assign({TaskId{3}, 1}, 2);
  return ledger;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(ledger)

BOOST_AUTO_TEST_CASE(in_the_beginning_nobody_has_anything) {
  Ledger ledger(3, 2);
  BOOST_TEST(ledger.tasks() == 3U);
  BOOST_TEST(ledger.done() == 0U);
  for (const Rank rank : {0U, 1U}) BOOST_TEST(ledger.held_by(rank) == 0U);
  for (std::uint32_t task = 0; task < 3; ++task) {
    BOOST_TEST(!ledger.is_done(TaskId{task}));
    BOOST_TEST(!ledger.has(1, TaskId{task}));
    BOOST_TEST((ledger.deliver(1, TaskId{task}) == Delivery::not_held));
  }
  BOOST_TEST(Ledger(0, 1).tasks() == 0U);
}

BOOST_AUTO_TEST_CASE(a_task_is_delivered_once_by_the_rank_that_has_it) {
  Ledger ledger(5, 3);
  ledger.assign({TaskId{1}, 3}, 2);
  BOOST_TEST(ledger.held_by(2) == 3U);
  BOOST_TEST(ledger.has(2, TaskId{3}));
  BOOST_TEST(!ledger.has(2, TaskId{4}));
  BOOST_TEST(!ledger.has(1, TaskId{3}));
  BOOST_TEST((ledger.deliver(1, TaskId{3}) == Delivery::not_held));
  BOOST_TEST((ledger.deliver(2, TaskId{3}) == Delivery::accepted));
  BOOST_TEST((ledger.deliver(2, TaskId{3}) == Delivery::not_held));
  BOOST_TEST(ledger.is_done(TaskId{3}));
  BOOST_TEST(!ledger.has(2, TaskId{3}));
  BOOST_TEST(ledger.held_by(2) == 2U);
  BOOST_TEST(ledger.done() == 1U);
}

BOOST_AUTO_TEST_CASE(what_the_holder_gives_up_is_open) {
  Ledger ledger(5, 3);
  ledger.assign({TaskId{0}, 2}, 1);
  BOOST_TEST(ledger.give_up(1, TaskId{1}));
  BOOST_TEST(!ledger.has(1, TaskId{1}));
  BOOST_TEST(ledger.held_by(1) == 1U);
  ledger.assign({TaskId{1}, 1}, 2);
  BOOST_TEST((ledger.deliver(2, TaskId{1}) == Delivery::accepted));
}

BOOST_AUTO_TEST_CASE(reopening_names_the_tasks_in_order_and_leaves_copies) {
  Ledger ledger(9, 3);
  ledger.assign({TaskId{6}, 2}, 1);
  ledger.assign({TaskId{2}, 1}, 1);
  ledger.assign({TaskId{4}, 1}, 2);
  ledger.assign({TaskId{0}, 1}, 1);
  ledger.deliver(1, TaskId{0});
  const std::vector<TaskId> opened = ledger.reopen_held_by(1);
  BOOST_TEST((opened == std::vector<TaskId>{TaskId{2}, TaskId{6}, TaskId{7}}));
  BOOST_TEST(ledger.held_by(1) == 3U);
  for (const TaskId task : opened) BOOST_TEST(ledger.has(1, task));
  BOOST_TEST(ledger.has(2, TaskId{4}));
  BOOST_TEST(ledger.reopen_held_by(1).empty());
}

BOOST_AUTO_TEST_CASE(the_first_copy_counts_and_the_other_is_late) {
  for (const Rank first : {1U, 2U}) {
    const Rank second = 3 - first;
    Ledger ledger = reissued();
    BOOST_TEST((ledger.deliver(3, TaskId{3}) == Delivery::not_held));
    BOOST_TEST((ledger.deliver(first, TaskId{3}) == Delivery::accepted));
    BOOST_TEST(ledger.has(second, TaskId{3}));
    BOOST_TEST(ledger.held_by(second) == 1U);
    BOOST_TEST((ledger.deliver(second, TaskId{3}) == Delivery::late));
    BOOST_TEST((ledger.deliver(second, TaskId{3}) == Delivery::not_held));
    BOOST_TEST((ledger.deliver(first, TaskId{3}) == Delivery::not_held));
    BOOST_TEST(ledger.done() == 1U);
    for (const Rank rank : {1U, 2U}) BOOST_TEST(ledger.held_by(rank) == 0U);
  }
}

BOOST_AUTO_TEST_CASE(a_copy_of_an_open_task_counts_too) {
  Ledger ledger(2, 2);
  ledger.assign({TaskId{0}, 1}, 1);
  ledger.reopen_held_by(1);
  BOOST_TEST((ledger.deliver(1, TaskId{0}) == Delivery::accepted));
  BOOST_TEST(ledger.held_by(1) == 0U);
}

BOOST_AUTO_TEST_CASE(giving_up_a_copy_opens_nothing) {
  Ledger ledger = reissued();
  BOOST_TEST(!ledger.give_up(1, TaskId{3}));
  BOOST_TEST(!ledger.has(1, TaskId{3}));
  BOOST_TEST(ledger.held_by(1) == 0U);
  BOOST_TEST((ledger.deliver(2, TaskId{3}) == Delivery::accepted));

  Ledger overtaken = reissued();
  overtaken.deliver(1, TaskId{3});
  BOOST_TEST(!overtaken.give_up(2, TaskId{3}));
  BOOST_TEST(overtaken.is_done(TaskId{3}));
  BOOST_TEST(overtaken.held_by(2) == 0U);
}

BOOST_AUTO_TEST_CASE(only_open_tasks_are_reclaimed) {
  Ledger ledger(6, 3);
  ledger.assign({TaskId{0}, 4}, 1);
  ledger.reopen_held_by(1);
  ledger.assign({TaskId{0}, 2}, 2);
  ledger.deliver(2, TaskId{1});
  BOOST_TEST(numbers_of(ledger.reclaim(1)) == (std::vector<std::uint32_t>{2, 3}), boost::test_tools::per_element());
  BOOST_TEST(ledger.held_by(1) == 4U);
  BOOST_TEST(ledger.reclaim(1).empty());
  BOOST_TEST(ledger.reclaim(2).empty());
  BOOST_TEST(ledger.give_up(1, TaskId{2}));
  BOOST_TEST(!ledger.give_up(1, TaskId{0}));
  BOOST_TEST((ledger.deliver(2, TaskId{0}) == Delivery::accepted));
}

BOOST_AUTO_TEST_CASE(a_rank_may_have_a_task_twice) {
  // It fell silent with it, so did the next one, and then it was its turn again.
  Ledger ledger = reissued();
  ledger.reopen_held_by(2);
  ledger.assign({TaskId{3}, 1}, 1);
  BOOST_TEST(ledger.held_by(1) == 2U);
  BOOST_TEST((ledger.deliver(1, TaskId{3}) == Delivery::accepted));
  BOOST_TEST(ledger.held_by(1) == 1U);
  BOOST_TEST((ledger.deliver(1, TaskId{3}) == Delivery::late));
  BOOST_TEST((ledger.deliver(1, TaskId{3}) == Delivery::not_held));
  BOOST_TEST((ledger.deliver(2, TaskId{3}) == Delivery::late));
}

BOOST_AUTO_TEST_CASE(whatever_happens_it_agrees_with_a_table_of_who_has_what) {
  constexpr std::uint32_t kTasks = 6;
  constexpr std::uint32_t kRanks = 4;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    std::mt19937_64 random(seed);
    Ledger ledger(kTasks, kRanks);
    std::uint32_t has[kRanks][kTasks] = {};
    std::optional<Rank> holder[kTasks];
    bool done[kTasks] = {};
    for (int step = 0; step < 200; ++step) {
      const Rank rank = static_cast<Rank>(random() % kRanks);
      const std::uint32_t index = static_cast<std::uint32_t>(random() % kTasks);
      const TaskId task{index};
      std::vector<std::uint32_t> expected;
      switch (random() % 5) {
        case 0:
          if (done[index] || holder[index]) break;
          ledger.assign({task, 1}, rank);
          holder[index] = rank;
          ++has[rank][index];
          break;
        case 1: {
          const Delivery wanted = has[rank][index] == 0 ? Delivery::not_held
                                  : done[index]         ? Delivery::late
                                                        : Delivery::accepted;
          BOOST_REQUIRE((ledger.deliver(rank, task) == wanted));
          if (wanted == Delivery::not_held) break;
          --has[rank][index];
          done[index] = true;
          holder[index].reset();
          break;
        }
        case 2:
          if (has[rank][index] == 0) break;
          BOOST_REQUIRE(ledger.give_up(rank, task) == (holder[index] == rank));
          --has[rank][index];
          if (holder[index] == rank) holder[index].reset();
          break;
        case 3:
          for (std::uint32_t i = 0; i < kTasks; ++i) {
            if (holder[i] != rank) continue;
            expected.push_back(i);
            holder[i].reset();
          }
          BOOST_REQUIRE(numbers_of(ledger.reopen_held_by(rank)) == expected);
          break;
        case 4:
          for (std::uint32_t i = 0; i < kTasks; ++i) {
            if (has[rank][i] == 0 || holder[i] || done[i]) continue;
            expected.push_back(i);
            holder[i] = rank;
          }
          BOOST_REQUIRE(numbers_of(ledger.reclaim(rank)) == expected);
          break;
      }
      for (Rank r = 0; r < kRanks; ++r) {
        std::uint32_t sum = 0;
        for (std::uint32_t i = 0; i < kTasks; ++i) {
          sum += has[r][i];
          BOOST_REQUIRE(ledger.has(r, TaskId{i}) == (has[r][i] > 0));
        }
        BOOST_REQUIRE(ledger.held_by(r) == sum);
      }
      BOOST_REQUIRE(ledger.done() == static_cast<std::uint32_t>(std::count(done, done + kTasks, true)));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
