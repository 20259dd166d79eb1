# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Script: writes OUTPUT, a source file that includes all *.cpp of DIR, the sources of the Verilated
# model NAME, and gives it verican_clock_edge() and, where something is combinational,
# verican_settle(), declared in NAME.h (sim/node/model_edge.hpp, sim/node/transmit_scan.hpp).
file(GLOB sources "${DIR}/*.cpp")
list(SORT sources)
set(text "")
set(settles FALSE)
foreach(source IN LISTS sources)
  get_filename_component(name "${source}" NAME)
  string(APPEND text "#include \"${name}\"\n")
  file(STRINGS "${source}" found REGEX "void ${NAME}___024root___eval_stl\\(" LIMIT_COUNT 1)
  if(found)
    set(settles TRUE)
  endif()
endforeach()
# The names of the functions are Verilator's own (5.006): what eval() calls once it has found an
# edge, and what it calls in the beginning to have all that is combinational follow the flip-flops.
set(declarations "void verican_clock_edge(${NAME}___024root *root);\n")
string(APPEND text "void verican_clock_edge(${NAME}___024root *root) {\n"
                   "  ${NAME}___024root___eval_nba(root);\n}\n")
if(settles)
  string(APPEND declarations "void verican_settle(${NAME}___024root *root);\n")
  string(APPEND text "void verican_settle(${NAME}___024root *root) {\n"
                     "  root->__VstlTriggered.at(0) = true;\n"
                     "  ${NAME}___024root___eval_stl(root);\n"
                     "  root->__VstlTriggered.at(0) = false;\n}\n")
endif()
file(WRITE "${OUTPUT}" "${text}")
file(APPEND "${DIR}/${NAME}.h" "${declarations}")
