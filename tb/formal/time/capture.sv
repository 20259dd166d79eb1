  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_capture, spliced into it. The halves are any numbers: that hi_i of the next
  // clock belongs to lo_i of this one is time.clock, p_exact. There is no reset.

  logic        f_take = 1'b0, f_have = 1'b0;
  logic [31:0] f_low;
  logic [63:0] f_time;
  always @(posedge clk_i) begin
    f_take <= take_i;
    if (take_i) f_low <= lo_i;
    if (f_take) {f_have, f_time} <= {1'b1, hi_i, f_low};
  end

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    // TM-11, TM-20: from the second clock on it is TIME of the clock of the last request.
    p_one_clock: assert (!f_have || f_take || time_o == f_time);
  end
