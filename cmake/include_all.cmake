# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Script: writes OUTPUT, a source file that includes all *.cpp of DIR, the sources of the Verilated
# model NAME. With SHORT_CUTS it gives it the functions below, as far as the model has them,
# declared in NAME.h. With ASSERT, clock edges are evaluated by eval(): what assertions look at
# ($past) is kept there alone.
# Their names are Verilator's own (5.006), of what eval() calls:
#   verican_clock_edge()  what is clocked, and all that follows from it (sim/node/model_edge.hpp)
#   verican_follow()      what follows from the inputs in the same clock (sim/node/quiet_engine.hpp)
#   verican_settle()      all that is combinational (sim/node/transmit_scan.hpp)
file(GLOB sources "${DIR}/*.cpp")
list(SORT sources)
set(text "")
set(declarations "")
set(code "")
foreach(source IN LISTS sources)
  get_filename_component(name "${source}" NAME)
  string(APPEND text "#include \"${name}\"\n")
  file(READ "${source}" content)
  string(APPEND code "${content}")
endforeach()

# A function `name` that runs a region of the model as if its first trigger had been met.
function(region name short)
  if(code MATCHES "void ${NAME}___024root___eval_${short}\\(")
    set(declarations "${declarations}void ${name}(${NAME}___024root *root);\n" PARENT_SCOPE)
    set(text "${text}void ${name}(${NAME}___024root *root) {
  root->__V${short}Triggered.at(0) = true;
  ${NAME}___024root___eval_${short}(root);
  root->__V${short}Triggered.at(0) = false;
}
" PARENT_SCOPE)
  endif()
endfunction()

if(SHORT_CUTS)
  string(APPEND declarations "void verican_clock_edge(${NAME}___024root *root);\n")
  set(edge "  ${NAME}___024root___eval_nba(root);\n")
  if(ASSERT)
    set(edge "  root->__Vtrigrprev__TOP__clk_i = 0;\n  ${NAME}___024root___eval(root);\n")
  endif()
  string(APPEND text "void verican_clock_edge(${NAME}___024root *root) {\n${edge}}\n")
  region(verican_follow ico)
  region(verican_settle stl)
endif()
file(WRITE "${OUTPUT}" "${text}")
file(APPEND "${DIR}/${NAME}.h" "${declarations}")
