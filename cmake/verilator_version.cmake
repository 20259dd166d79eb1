# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# verican_has_short_cuts(<result> <text>): TRUE if <text>, what `verilator --version` says, is of
# the Verilator whose models the simulator may look into (sim/node/model_edge.hpp): their members
# and functions have other names in other versions. Models of those are clocked plainly.
function(verican_has_short_cuts result text)
  if(text MATCHES "^Verilator 5\\.006 ")
    set(${result} TRUE PARENT_SCOPE)
  else()
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()
