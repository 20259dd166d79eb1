// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_capture: captures all 64 bits of TIME in one clock (TM-11, TM-20).

module can_capture (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        take_i,    // pulse: capture
  input  logic [63:0] now_i,     // TIME in this clock
  output logic [63:0] time_o     // TIME of the clock of the last take_i
);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)     time_o <= '0;
    else if (take_i) time_o <= now_i;
  end
endmodule
