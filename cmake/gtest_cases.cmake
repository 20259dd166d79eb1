# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Tests in C++: each case of a GoogleTest program is a test of ctest.
include(GoogleTest)

# verican_gtest_cases(PROGRAM LABEL [PREFIX text] [TIMEOUT seconds]): the tests have the names that
# --gtest_filter takes, behind the prefix, so that a name from a report finds its case. Values of
# parameters are none of it: those without a text are printed as bytes, padding and all.
function(verican_gtest_cases program label)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "PREFIX;TIMEOUT" "")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  gtest_discover_tests(${program}
    DISCOVERY_MODE PRE_TEST
    DISCOVERY_TIMEOUT 60
    NO_PRETTY_VALUES
    TEST_PREFIX "${arg_PREFIX}"
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
    PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS ${label})
endfunction()
