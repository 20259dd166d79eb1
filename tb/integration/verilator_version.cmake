# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Script: models of the Verilator that the simulator knows have short cuts, those of others none.
include("${CMAKE_CURRENT_LIST_DIR}/../../cmake/verilator_version.cmake")

function(expect expected text)
  verican_has_short_cuts(found "${text}")
  if(NOT found STREQUAL expected)
    message(SEND_ERROR "'${text}': ${found} instead of ${expected}")
  endif()
endfunction()

expect(TRUE "Verilator 5.006 2023-01-22 rev (Debian 5.006-3)")
expect(FALSE "Verilator 5.0061 2023-01-22 rev (Debian 5.006-3)")
expect(FALSE "Verilator 5.020 2024-01-01 rev (Debian 5.020-1)")
expect(FALSE "Verilator 5.042 2025-11-02 rev v5.042")
expect(FALSE "Verilator 4.038 2020-07-11 rev v4.036-114-g0cd4a57ad")
expect(FALSE "")
