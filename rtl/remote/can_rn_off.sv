// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_off: bus-off (RN-72). Recovery has to wait for BOFF x 2^k ms. k grows with each bus-off
// and returns to 0 10 s after the last recovery. Byte 3 of the variables counts both times down, in
// steps of 2^k ms in bus-off and of 256 ms otherwise; JobTurn loads it.

module can_rn_off (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,       // present job
  input  logic             last_i,      // phase 2 or 3
  input  logic             timer_i,     // timer of JobLow, JobHigh: 0 watchdog, 1 milliseconds
  input  logic [7:0]       byte_i,      // byte read
  input  logic             zero_i,      // byte read is 0
  output logic             off_o,       // node is in bus-off, as noted by the last JobTurn
  output logic             entry_o,     // pulse: node enters bus-off
  output logic             exit_o,      // pulse: node leaves bus-off
  output logic             carry_o,     // JobLow: JobHigh follows, the high byte counts
  output logic             release_o    // pulse: recovery from bus-off may complete
);
  logic       off_q, turn, over;
  logic [2:0] k_q;
  logic [7:0] mask;

  assign turn      = job_i == can_rn_pkg::JobTurn && last_i;
  assign entry_o   = turn && !off_q;
  assign exit_o    = turn && off_q;
  assign over      = job_i == can_rn_pkg::JobHigh && timer_i && last_i && zero_i;
  assign release_o = over && off_q;
  assign off_o     = off_q;

  always_comb begin
    for (int i = 0; i < 7; i++) mask[i] = !off_q || k_q > 3'(i);
    mask[7] = !off_q;
  end
  // JobLow also counts the watchdog with this mask. That is harmless in bus-off, because the
  // watchdog is reloaded when bus-off ends.
  assign carry_o = !(|(byte_i & mask));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      off_q <= 1'b0;
      k_q   <= '0;
    end else begin
      off_q <= off_q ^ turn;
      if (over && !off_q)             k_q <= '0;
      else if (exit_o && !(&k_q))     k_q <= k_q + 3'd1;
    end
  end

endmodule
