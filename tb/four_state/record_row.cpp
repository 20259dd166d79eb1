// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// hex(): a row of pins as text; the layout is that of replay.sv.
#include <fmt/format.h>

#include "four_state/record_node.hpp"

namespace vericansim {

std::string hex(const PinRow &row) {
  const AhbRequest &r = row.request;
  const bool selected = r.htrans != AhbTrans::kIdle;
  // Each field has hexadecimal digits of its own, so that a row can be read.
  return fmt::format(
      "{:x}{:x}{:08x}{:x}{:x}{:x}{:x}{:x}{:x}{:08x}{:x}{:x}_{:x}{:08x}{:x}{:x}{:02x}{:x}{:013x}",
      int{row.hresetn}, int{selected}, r.haddr, static_cast<unsigned>(r.htrans), int{r.hwrite},
      static_cast<unsigned>(r.hsize), static_cast<unsigned>(r.hburst), unsigned{r.hprot},
      int{row.hready}, r.hwdata, int{row.stop_req} | int{row.ext} << 1, int{row.can_rx},
      int{row.read_ends}, row.hrdata, int{row.hreadyout}, int{row.hresp}, unsigned{row.irq},
      int{row.can_tx} | int{row.time_out} << 1, row.trace);
}

}  // namespace vericansim
