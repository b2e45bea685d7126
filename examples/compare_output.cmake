# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DCOMMAND=PROGRAM;ARGUMENTS -DEXPECTED=FILE -P compare_output.cmake: fails unless the program succeeds and prints what the file holds.
execute_process(COMMAND ${COMMAND} OUTPUT_VARIABLE output ERROR_VARIABLE errors RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${COMMAND} ends with ${result}:\n${output}${errors}")
endif()
file(READ ${EXPECTED} expected)
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "${COMMAND} prints\n${output}and not, as ${EXPECTED} says,\n${expected}")
endif()
