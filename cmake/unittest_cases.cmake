# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Tests in Python that work the tool: each method test_... of a unittest module is a test of ctest.

# verican_unittest_cases(FILE LABEL [NAME=VALUE ...]): FILE with its folder; the tests are
# LABEL.Class.method, with the values in their environment. One that skips itself is skipped.
function(verican_unittest_cases file label)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  get_filename_component(module "${file}" NAME_WE)
  get_filename_component(folder "${file}" DIRECTORY)
  file(STRINGS "${file}" lines REGEX "^class |^    def test_")
  foreach(line IN LISTS lines)
    if(line MATCHES "^class ([A-Za-z]+)")
      set(class "${CMAKE_MATCH_1}")
    elseif(line MATCHES "def test_([a-z_]+)")
      set(name "${label}.${class}.${CMAKE_MATCH_1}")
      add_test(NAME "${name}"
               COMMAND "${VERICAN_PYTHON}" -B -m unittest
                       "${module}.${class}.test_${CMAKE_MATCH_1}"
               WORKING_DIRECTORY "${folder}")
      set_tests_properties("${name}" PROPERTIES LABELS "${label}" TIMEOUT 300
                           SKIP_REGULAR_EXPRESSION "\nOK \\(skipped="
                           ENVIRONMENT "VERICAN_BINARY=$<TARGET_FILE:verican>;${ARGN}")
    endif()
  endforeach()
endfunction()
