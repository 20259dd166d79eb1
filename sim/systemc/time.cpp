// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Time: see time.hpp.
#include "systemc/time.hpp"

namespace vericansim {

void check_time_resolution() {
  if (sc_core::sc_get_time_resolution() != sc_core::sc_time(1, sc_core::SC_PS)) {
    SC_REPORT_FATAL("vericansystemc", "the time resolution must be 1 ps, SystemC's default");
  }
}

}  // namespace vericansim
