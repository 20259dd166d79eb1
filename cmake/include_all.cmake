# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Script: writes OUTPUT, a source file that includes all *.cpp of DIR, the sources of the Verilated
# model NAME, and gives it verican_clock_edge(), declared in NAME.h (sim/node/model_edge.hpp).
file(GLOB sources "${DIR}/*.cpp")
list(SORT sources)
set(text "")
foreach(source IN LISTS sources)
  get_filename_component(name "${source}" NAME)
  string(APPEND text "#include \"${name}\"\n")
endforeach()
# The name of the function is Verilator's own (5.006): what eval() calls once it has found an edge.
string(APPEND text "void verican_clock_edge(${NAME}___024root *root) {\n"
                   "  ${NAME}___024root___eval_nba(root);\n}\n")
file(WRITE "${OUTPUT}" "${text}")
file(APPEND "${DIR}/${NAME}.h" "void verican_clock_edge(${NAME}___024root *root);\n")
