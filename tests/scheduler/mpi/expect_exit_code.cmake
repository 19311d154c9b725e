# SPDX-License-Identifier: BSD-3-Clause
# cmake -DEXPECTED=65 -DSECONDS=20 -P expect_exit_code.cmake -- COMMAND...: passes if COMMAND ends within that time with
# that exit code.
set(command "")
set(after_dashes FALSE)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE ${last})
  if(after_dashes)
    list(APPEND command "${CMAKE_ARGV${i}}")
  elseif(CMAKE_ARGV${i} STREQUAL "--")
    set(after_dashes TRUE)
  endif()
endforeach()
execute_process(COMMAND ${command} TIMEOUT ${SECONDS} RESULT_VARIABLE result)
if(NOT result STREQUAL "${EXPECTED}")
  message(FATAL_ERROR "ended with '${result}' instead of ${EXPECTED}")
endif()
