# SPDX-License-Identifier: BSD-3-Clause
# Each from a Debian 12 package; scripts/install_packages.sh installs them all.
find_package(MPI REQUIRED COMPONENTS CXX)   # libopenmpi-dev: messages between ranks
find_package(PNG REQUIRED)                  # libpng-dev: pictures
find_package(Threads REQUIRED)              # several threads build one tree
find_package(CLI11 REQUIRED)                # libcli11-dev: the command line
find_package(PkgConfig REQUIRED)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)  # libtomlplusplus-dev: scenes, with line and column of every value
pkg_check_modules(gmpxx REQUIRED IMPORTED_TARGET gmpxx)                # libgmp-dev: integers of any size, for exact decisions
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)           # libxxhash-dev: checksums
pkg_check_modules(lz4 REQUIRED IMPORTED_TARGET liblz4)                 # liblz4-dev: tiles packed for the way between nodes
if(TESSERA_SIMULATION)
  pkg_check_modules(simgrid REQUIRED IMPORTED_TARGET simgrid)          # libsimgrid-dev: ranks and networks that are not there
endif()
if(TESSERA_BUILD_TESTS)
  find_package(Boost 1.74 REQUIRED COMPONENTS unit_test_framework)     # libboost-test-dev
  find_package(Python3 REQUIRED COMPONENTS Interpreter)                # python3: command line tests
endif()
