// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_wake: detects a recessive-to-dominant edge of the bus in stop mode (flexcan.md 2.9, MO-14),
// with an optional glitch filter. A bus that is dominant when stop mode begins must become
// recessive first. can_mode leaves stop mode, can_flags sets WAK_INT.

module can_wake #(
  /// Clocks for which the bus must be dominant if filter_i = 1, 1 to 255. A bit has eight clocks or
  /// more, so 6 passes every dominant bit and blocks shorter pulses (docs/integration.md).
  parameter int FilterClocks = 6
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic enable_i,      // 1: stop mode, with MCR.SLF_WAK
  input  logic filter_i,      // MCR.WAK_SRC: the edge is filtered
  input  logic rx_i,          // level of the bus, synchronised
  output logic wake_o         // pulse: the bus ends stop mode
);
  if (FilterClocks < 1 || FilterClocks > 255) begin : gen_check_filter_clocks
    FilterClocks_must_be_1_to_255 u_stop ();   // no such module: the tool prints the name and stops
  end

  logic       armed_q;        // 1: the bus has been recessive since stop mode began
  logic [7:0] count_q;        // clocks that the bus must still be dominant
  assign wake_o = enable_i && armed_q && rx_i == can_pkg::Dominant && (!filter_i || count_q == '0);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      armed_q <= 1'b0;
      count_q <= '0;
    end else if (!enable_i || wake_o) begin
      armed_q <= 1'b0;
      count_q <= '0;
    end else if (rx_i == can_pkg::Recessive) begin
      armed_q <= 1'b1;
      count_q <= 8'(FilterClocks - 1);
    end else if (count_q != '0) begin
      count_q <= count_q - 1'b1;
    end
  end
endmodule
