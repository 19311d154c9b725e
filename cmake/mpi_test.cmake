# SPDX-License-Identifier: BSD-3-Clause
# What every test under mpirun needs: root in a container, more ranks than cores, and room to fail instead of hanging.
# tessera_set_mpi_test_properties(test ranks)
function(tessera_set_mpi_test_properties test ranks)
  set(environment OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
  if(TESSERA_SANITIZE)
    list(APPEND environment ASAN_OPTIONS=detect_leaks=0)  # Open MPI itself leaks
  endif()
  set_tests_properties(${test} PROPERTIES
    PROCESSORS ${ranks} TIMEOUT 120 LABELS mpi ENVIRONMENT "${environment}")
endfunction()

# tessera_add_mpi_test(name RANKS 1 2 ... NODES_OF 1 ... SOURCES ... LIBRARIES ...): a Boost.Test program that runs under
# mpirun, known to ctest as <name>_<n>ranks, once per rank count. It fails if a test fails on any rank or if there are not
# n ranks. The most ranks also run as several nodes of at most m each, as <name>_<n>ranks_<m>anode.
function(tessera_add_mpi_test name)
  cmake_parse_arguments(arg "" "" "RANKS;NODES_OF;SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES} ${PROJECT_SOURCE_DIR}/tests/scheduler/mpi/test_main.cpp)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE BOOST_TEST_DYN_LINK)
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} tessera_mpi Boost::unit_test_framework tessera_warnings)
  foreach(ranks IN LISTS arg_RANKS)
    add_test(NAME ${name}_${ranks}ranks
      COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} --oversubscribe
              $<TARGET_FILE:${name}> --log_level=warning -- ${ranks})
    tessera_set_mpi_test_properties(${name}_${ranks}ranks ${ranks})
  endforeach()
  list(GET arg_RANKS -1 ranks)
  foreach(most IN LISTS arg_NODES_OF)
    add_test(NAME ${name}_${ranks}ranks_${most}anode
      COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} --oversubscribe
              $<TARGET_FILE:${name}> --log_level=warning -- ${ranks} ${most})
    tessera_set_mpi_test_properties(${name}_${ranks}ranks_${most}anode ${ranks})
  endforeach()
endfunction()
