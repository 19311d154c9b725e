// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/task.h"

#include <boost/test/unit_test.hpp>

namespace tessera::scheduler {

BOOST_AUTO_TEST_SUITE(run_list)

BOOST_AUTO_TEST_CASE(neighbouring_tasks_share_a_run) {
  RunList runs;
  for (const std::uint32_t task : {4U, 5U, 6U, 9U, 10U, 2U}) BOOST_TEST(runs.push(TaskId{task}));
  BOOST_REQUIRE_EQUAL(runs.size(), 3U);
  BOOST_TEST((runs.begin()[0] == TaskRun{TaskId{4}, 3}));
  BOOST_TEST((runs.begin()[1] == TaskRun{TaskId{9}, 2}));
  BOOST_TEST((runs.begin()[2] == TaskRun{TaskId{2}, 1}));
  BOOST_TEST(runs.tasks() == 6U);
}

BOOST_AUTO_TEST_CASE(a_full_list_takes_only_what_lengthens_its_last_run) {
  RunList runs;
  for (const std::uint32_t task : {0U, 2U, 4U}) runs.push(TaskId{task});
  BOOST_TEST(!runs.push(TaskId{6}));
  BOOST_TEST(!runs.push(TaskId{3}));
  BOOST_TEST(runs.push(TaskId{5}));
  BOOST_TEST(runs.tasks() == 4U);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
