# SPDX-License-Identifier: BSD-3-Clause
# Each from a Debian 12 package; scripts/install_packages.sh installs them all.
find_package(MPI REQUIRED COMPONENTS CXX)   # libopenmpi-dev: messages between ranks
if(TESSERA_BUILD_TESTS)
  find_package(Boost 1.74 REQUIRED COMPONENTS unit_test_framework)     # libboost-test-dev
endif()
