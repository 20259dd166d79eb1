# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# verican bridge --socketcand with python-can of the system's Python as the other side: each method
# test_... of socketcand_cases.py is a test.
set(cases_file "${CMAKE_CURRENT_LIST_DIR}/socketcand_cases.py")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${cases_file}")
file(STRINGS "${cases_file}" lines REGEX "^class |^    def test_")
foreach(line IN LISTS lines)
  if(line MATCHES "^class ([A-Za-z]+)")
    set(class "${CMAKE_MATCH_1}")
  elseif(line MATCHES "def test_([a-z_]+)")
    set(name "socketcand.${class}.${CMAKE_MATCH_1}")
    add_test(NAME "${name}"
             COMMAND "${VERICAN_PYTHON}" -B -m unittest
                     "socketcand_cases.${class}.test_${CMAKE_MATCH_1}"
             WORKING_DIRECTORY "${CMAKE_CURRENT_LIST_DIR}")
    set_tests_properties("${name}" PROPERTIES LABELS socketcan TIMEOUT 300
                         ENVIRONMENT "VERICAN_BINARY=$<TARGET_FILE:verican>")
  endif()
endforeach()
