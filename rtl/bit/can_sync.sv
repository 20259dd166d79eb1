// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_sync: brings the asynchronous CAN receive pin into the clock domain with two flip-flops.
// Its delay of one to two clocks counts as node delay (BT-06).

module can_sync (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic can_rx_i,  // asynchronous pad
  output logic rx_o       // settled level, recessive after reset
);

  logic meta_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {rx_o, meta_q} <= {2{can_pkg::Recessive}};
    else         {rx_o, meta_q} <= {meta_q, can_rx_i};
  end

endmodule
