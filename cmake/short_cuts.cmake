# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The simulator's short cuts (docs/simulator.md, Nodes) do in closed form what one text of the RTL
# does. sim/node/short_cuts.txt has the digest of the text that they are proven for; models of any
# other are clocked plainly, so that what is simulated is always the RTL as it stands.
#
# verican_short_cuts_fit(<result> <text of that file> <RTL file>...): TRUE if it has their digest.
#
# Script, after a change of the RTL: cmake -P cmake/short_cuts.cmake
# writes the digest of the RTL as it is; the tests that short_cuts.txt names prove it.
function(verican_rtl_digest result)
  set(digests "")
  foreach(file IN LISTS ARGN)
    file(READ "${file}" text)
    # Comments and white space are the same hardware.
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REGEX REPLACE "[ \t\r\n]+" " " text "${text}")
    get_filename_component(name "${file}" NAME)
    string(SHA256 digest "${text}")
    string(APPEND digests "${name} ${digest}\n")
  endforeach()
  string(SHA256 digest "${digests}")
  set(${result} "${digest}" PARENT_SCOPE)
endfunction()

function(verican_short_cuts_fit result list)
  verican_rtl_digest(digest ${ARGN})
  if(list MATCHES "(^|\n)${digest}(\n|$)")
    set(${result} TRUE PARENT_SCOPE)
  else()
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  get_filename_component(PROJECT_SOURCE_DIR "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)
  include("${CMAKE_CURRENT_LIST_DIR}/rtl.cmake")
  verican_rtl_digest(digest ${VERICAN_RTL})
  set(list "${PROJECT_SOURCE_DIR}/sim/node/short_cuts.txt")
  file(READ "${list}" text)
  string(REGEX REPLACE "(^|\n)[0-9a-f]+\n" "\\1${digest}\n" text "${text}")
  file(WRITE "${list}" "${text}")
  message(STATUS "${list}: ${digest}; now run the tests that it names")
endif()
