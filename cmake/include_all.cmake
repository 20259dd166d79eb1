# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Script: writes OUTPUT, a source file that includes all *.cpp of DIR.
file(GLOB sources "${DIR}/*.cpp")
list(SORT sources)
set(text "")
foreach(source IN LISTS sources)
  get_filename_component(name "${source}" NAME)
  string(APPEND text "#include \"${name}\"\n")
endforeach()
file(WRITE "${OUTPUT}" "${text}")
