// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// remote_icestick: a remote node on Lattice's iCEstick (iCE40 HX1K, 12 MHz), number 3.

module remote_icestick #(
  /// Serial number, different in each device; here that of the golden vectors.
  parameter int Serial = 32'hCAFE1234
) (
  input  logic       clk_i,
  input  logic       can_rx_i,
  output logic       can_tx_o,
  input  logic [1:0] inputs_i,
  output logic [3:0] outputs_o,
  output logic [4:0] leds_o      // on the bus, OPERATE, a write, outputs 0 and 1
);
  logic [1:0] state;
  logic       seen;

  remote_io #(.Serial(Serial), .Outputs(4), .Inputs(2)) u_io (
    .clk_i, .number_i(3'd3), .inputs_i, .outputs_o, .state_o(state), .seen_o(seen),
    .can_rx_i, .can_tx_o
  );
  assign leds_o = {outputs_o[1:0], seen, &state, state[1]};

endmodule
