// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_capture: TIME of one clock, all 64 bits: the upper half of can_clock is a clock behind the
// lower one, and is taken a clock later (TM-11, TM-18, TM-20).

module can_capture (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        take_i,
  input  logic [31:0] lo_i,
  input  logic [31:0] hi_i,
  output logic [63:0] time_o     // TIME of the clock of take_i, from the second clock after it on
);
  logic take_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      take_q <= 1'b0;
      time_o <= '0;
    end else begin
      take_q <= take_i;
      if (take_i) time_o[31:0]  <= lo_i;
      if (take_q) time_o[63:32] <= hi_i;
    end
  end
endmodule
