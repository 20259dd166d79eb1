  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Property of can_mailbox, spliced into it: who gets a read slot.

  always @(posedge clk_i) begin
    // flexcan.md 3.3: arbitration and match read what they have asked for, one at a time.
    p_slots: assert (!rst_ni || ((!ins_gnt || ins_req) && (!scan_gnt || scan_req)
        && (!rx_gnt || rx_req) && 2'(ins_gnt) + 2'(scan_gnt) + 2'(rx_gnt) < 2'd2));
  end
