// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/launcher.h"

#include <boost/test/unit_test.hpp>
#include <cstdlib>

namespace tessera::scheduler {
namespace {

struct CleanEnvironment {
  CleanEnvironment() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"}) unsetenv(name);
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(launcher, CleanEnvironment)

BOOST_AUTO_TEST_CASE(without_a_launcher_there_is_rank_0) {
  BOOST_TEST(!launched_by_mpi());
  BOOST_TEST(launched_rank() == 0U);
}

BOOST_AUTO_TEST_CASE(open_mpi_is_known_by_its_size) {
  setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
  setenv("OMPI_COMM_WORLD_RANK", "3", 1);
  BOOST_TEST(launched_by_mpi());
  BOOST_TEST(launched_rank() == 3U);
}

BOOST_AUTO_TEST_CASE(other_launchers_are_known_by_their_rank) {
  for (const char* name : {"PMIX_RANK", "PMI_RANK"}) {
    CleanEnvironment();
    setenv(name, "12", 1);
    BOOST_TEST(launched_by_mpi());
    BOOST_TEST(launched_rank() == 12U);
  }
}

BOOST_AUTO_TEST_CASE(a_rank_that_is_no_number_is_0) {
  setenv("PMI_RANK", "2x", 1);
  BOOST_TEST(launched_rank() == 0U);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
