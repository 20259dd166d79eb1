// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_timestamp: TIMER, free-running counter of nominal bit times (flexcan.md section 6). It is
// part of the engine, so that nothing on the host side changes in a bit without an event.

module can_timestamp (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,      // soft reset, or TSYN; a write in the same clock is lost (2.10)
  input  logic        sample_i,     // pulse: sample point, while the engine runs
  input  logic        we_i,         // pulse: write by the CPU
  input  logic [1:0]  be_i,         // byte enables
  input  logic [15:0] wdata_i,      // value to write
  output logic [15:0] timer_o       // TIMER
);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      timer_o <= '0;
    end else if (clear_i) begin
      timer_o <= '0;
    end else if (we_i) begin
      if (be_i[0]) timer_o[7:0]  <= wdata_i[7:0];
      if (be_i[1]) timer_o[15:8] <= wdata_i[15:8];
    end else if (sample_i) begin
      timer_o <= timer_o + 1'b1;
    end
  end
endmodule
