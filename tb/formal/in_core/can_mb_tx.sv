  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What host.tx assumes of can_mb_port and can_mb_step.

  always @(posedge clk_i) if (rst_ni) begin
    m_slots: assert ((!ins_gnt_i || ins_req_o) && (!scan_gnt_i || (scan_req_o && !ins_gnt_i)));
  end
