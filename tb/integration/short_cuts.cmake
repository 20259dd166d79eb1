# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Script (WORK: a directory for copies of the RTL): the simulator's short cuts fit the RTL as it is,
# with other comments too, and no RTL with other code.
get_filename_component(PROJECT_SOURCE_DIR "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
include("${PROJECT_SOURCE_DIR}/cmake/short_cuts.cmake")
include("${PROJECT_SOURCE_DIR}/cmake/rtl.cmake")
file(READ "${PROJECT_SOURCE_DIR}/sim/node/short_cuts.txt" list)

function(expect expected what)
  verican_short_cuts_fit(found "${list}" ${ARGN})
  if(NOT found STREQUAL expected)
    message(SEND_ERROR "${what}: ${found} instead of ${expected}")
  endif()
endfunction()

# The files of the RTL with BEFORE replaced by AFTER in can_error.sv.
function(edited result before after)
  set(files "")
  foreach(file IN LISTS VERICAN_RTL)
    if(file MATCHES "/can_error\\.sv$")
      file(READ "${file}" text)
      string(REPLACE "${before}" "${after}" text "${text}")
      set(file "${WORK}/can_error.sv")
      file(WRITE "${file}" "${text}")
    endif()
    list(APPEND files "${file}")
  endforeach()
  set(${result} "${files}" PARENT_SCOPE)
endfunction()

expect(TRUE "the RTL; after a change of its code: cmake -P cmake/short_cuts.cmake" ${VERICAN_RTL})
edited(files "module can_error" "// Another comment.\n\nmodule   can_error")
expect(TRUE "another comment" ${files})
edited(files "endmodule" "  logic more;\nendmodule")
expect(FALSE "more code" ${files})
list(REVERSE VERICAN_RTL)
expect(FALSE "another order" ${VERICAN_RTL})
