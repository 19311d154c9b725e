# SPDX-License-Identifier: BSD-3-Clause
# tessera_add_library(name SOURCES... ): a library of src/<folder>, included as "folder/file.h".
function(tessera_add_library name)
  add_library(${name} STATIC ${ARGN})
  add_library(tessera::${name} ALIAS ${name})
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include/tessera>)
  target_link_libraries(${name} PUBLIC tessera_flags PRIVATE $<BUILD_INTERFACE:tessera_warnings>)
endfunction()

# tessera_add_test(name LIBRARIES... [SOURCES ...]): a Boost.Test program in one process, known to ctest as <name>.
function(tessera_add_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES} ${PROJECT_SOURCE_DIR}/tests/test_main.cpp)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE BOOST_TEST_DYN_LINK)
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} Boost::unit_test_framework tessera_warnings)
  add_test(NAME ${name} COMMAND ${name} --log_level=warning)
  set_tests_properties(${name} PROPERTIES TIMEOUT 120)
endfunction()
