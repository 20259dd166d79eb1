// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_wake: a recessive-to-dominant edge of the bus in stop mode (flexcan.md 2.9). A bus that is
// dominant when stop mode begins must have been recessive first.

module can_wake #(
  /// Clocks that the filtered line must be dominant, 1 to 255. A bit has eight or more, so 6 lets
  /// every dominant bit through and stops what is shorter; see docs/integration.md for more.
  parameter int FilterClocks = 6
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic enable_i,      // stop mode, with SLF_WAK
  input  logic filter_i,      // WAK_SRC
  input  logic rx_i,          // level of the bus, synchronised
  output logic wake_o         // pulse
);
  if (FilterClocks < 1 || FilterClocks > 255) begin : gen_check_filter_clocks
    FilterClocks_must_be_1_to_255 u_stop ();   // no such module: the tool prints the name and stops
  end

  logic       armed_q;        // has been recessive
  logic [7:0] count_q;        // dominant clocks still missing
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
