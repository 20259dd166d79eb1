// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// remote_hx8k: a remote node on Lattice's HX8K breakout board (iCE40 HX8K, 12 MHz). Three pins of a
// header set its number; open pins are pulled up: 7.

module remote_hx8k #(
  /// Serial number, different in each device; here that of the golden vectors.
  parameter int Serial = 32'hCAFE1234
) (
  input  logic       clk_i,
  input  logic       can_rx_i,
  output logic       can_tx_o,
  input  logic [2:0] number_i,
  input  logic [1:0] inputs_i,
  output logic [7:0] leds_o      // the byte at 0x010
);
  remote_io #(.Serial(Serial), .Full(1'b1), .Outputs(8), .Inputs(2)) u_io (
    .clk_i, .number_i, .inputs_i, .outputs_o(leds_o), .state_o(), .seen_o(),
    .can_rx_i, .can_tx_o
  );

endmodule
