// SPDX-License-Identifier: BSD-3-Clause
// Main of every test program that runs in one process. An operation that makes a NaN ends its test: no input that
// passes the readers may lead to one. Boost.Test masks such traps unless it is asked to detect them.
#define BOOST_TEST_MODULE tessera
#define BOOST_TEST_NO_MAIN
#include <boost/test/unit_test.hpp>
#include <cstdlib>

int main(int argc, char** argv) {
  setenv("BOOST_TEST_DETECT_FP_EXCEPTIONS", "yes", 0);
  return boost::unit_test::unit_test_main(&init_unit_test, argc, argv);
}
