# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# VERICAN_RTL: the files of rtl/can.f, absolute, in the order of the data path.
set(VERICAN_RTL_DIR "${PROJECT_SOURCE_DIR}/rtl" CACHE PATH "The RTL, or a copy that was broken")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${VERICAN_RTL_DIR}/can.f")

file(STRINGS "${VERICAN_RTL_DIR}/can.f" rtl_lines REGEX "^[^#]*\\.sv[ \t]*$")
set(VERICAN_RTL "")
foreach(line IN LISTS rtl_lines)
  string(STRIP "${line}" line)
  list(APPEND VERICAN_RTL "${VERICAN_RTL_DIR}/${line}")
endforeach()
