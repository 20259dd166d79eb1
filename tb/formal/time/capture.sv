  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_capture, spliced into it. What TIME is says time.clock, p_exact. There is no
  // reset.

  logic        f_have = 1'b0;
  logic [63:0] f_time;
  always @(posedge clk_i) if (take_i) {f_have, f_time} <= {1'b1, now_i};

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    // TM-11, TM-20: it is TIME of the clock of the last request, until the next.
    p_one_clock: assert (!f_have || time_o == f_time);
  end
