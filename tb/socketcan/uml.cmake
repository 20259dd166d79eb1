# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# `verican bridge` on the CAN of a real kernel, a user-mode Linux; recordings with outside tools.
if(NOT TARGET verican OR NOT VERICAN_PYTHON)
  return()
endif()

# Processors with AMX: see the source. Never sanitized, it goes into a kernel.
add_library(wide_xstate MODULE "${PROJECT_SOURCE_DIR}/sw/linux/host/wide_xstate.c")
set_target_properties(wide_xstate PROPERTIES PREFIX "" COMPILE_OPTIONS "" LINK_OPTIONS "")

set(sanitized)
if(VERICAN_ASAN)
  set(sanitized --sanitized)
endif()

# verican_socketcan_case(NAME [REQUIRES CASE]): one case of uml/cases.py as a test; REQUIRES: it
# judges again what that case left.
function(verican_socketcan_case name)
  cmake_parse_arguments(arg "" "REQUIRES" "" ${ARGN})
  add_test(NAME socketcan.${name}
           COMMAND "${VERICAN_PYTHON}" -B "${PROJECT_SOURCE_DIR}/tb/socketcan/uml/run.py" ${name}
                   --verican $<TARGET_FILE:verican> --shim $<TARGET_FILE:wide_xstate>
                   --client $<TARGET_FILE:remote_golden_client>
                   --out "${CMAKE_CURRENT_BINARY_DIR}/out" ${sanitized})
  set_tests_properties(socketcan.${name} PROPERTIES
    LABELS socketcan TIMEOUT 300 SKIP_RETURN_CODE 77 FIXTURES_SETUP socketcan_${name})
  if(arg_REQUIRES)
    set_tests_properties(socketcan.${name} PROPERTIES
                         FIXTURES_REQUIRED socketcan_${arg_REQUIRES})
  endif()
endfunction()

foreach(case guest-time-limit guest-killed recording-tshark recording-asc recording-canplayer)
  verican_socketcan_case(${case})
endforeach()
# Each red case spoils what its case has left: the judge must notice.
foreach(case flood duel tools errors interfaces vxcan signals remote stacks)
  verican_socketcan_case(${case})
  verican_socketcan_case(red-${case} REQUIRES ${case})
endforeach()
