  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_mailbox, spliced into it: who gets a read slot, what a command tells twice.

  always @(posedge clk_i) begin
    // flexcan.md 3.3: arbitration and match read what they have asked for, one at a time.
    p_slots: assert (!rst_ni || ((!ins_gnt || ins_req) && (!scan_gnt || scan_req)
        && (!rx_gnt || rx_req) && 2'(ins_gnt) + 2'(scan_gnt) + 2'(rx_gnt) < 2'd2));
    // flexcan.md 3.4: whose C/S word a write means is told before it is known to be one.
    p_row: assert (!rst_ni || !(cmd_wr_i && cmd_mem_sel_i == can_mb_pkg::MemCs)
                   || cmd_mb_i == cmd_idx_i);
  end
