  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Property of can_flags with fewer than 64 buffers, spliced into it.

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    // flexcan.md 1.5: IFLAG and IMASK of buffers that do not exist read 0.
    p_absent: assert (!rst_ni || ((iflag_o | imask_o) >> NumMb) == '0);
  end
