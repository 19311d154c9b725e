// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/grain.h"

#include <boost/test/unit_test.hpp>

namespace tessera::scheduler {

BOOST_AUTO_TEST_SUITE(grain)

BOOST_AUTO_TEST_CASE(a_task_lasts_while_rank_0_serves_all_three_times_but_no_less_than_100_us) {
  BOOST_TEST(least_task_s(100, 2) == 100e-6);
  BOOST_TEST(least_task_s(100, 64) == 576e-6, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(little_work_makes_small_tasks) {
  // sqrt(W o) = sqrt(3 ms * 3 us) = 94.9 us
  BOOST_TEST(least_task_s(3e-3, 64) == 94.868e-6, boost::test_tools::tolerance(1e-4));
  BOOST_TEST(least_task_s(0, 64) == 0.0);
}

BOOST_AUTO_TEST_CASE(tasks_shrink_with_what_remains) {
  BOOST_TEST(largest_task_s(8, 8, 2) == 1.0);
  BOOST_TEST(largest_task_s(4, 8, 2) == 0.5);
  BOOST_TEST(largest_task_s(0, 8, 2) == 100e-6);
}

BOOST_AUTO_TEST_CASE(x_is_work_over_handing_out) {
  BOOST_TEST(work_ratio(0.0768, 16) == 100.0, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
