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

  // A synchroniser: side by side, neither merged nor copied nor made a shift register.
  // For Vivado, for Quartus, for Synplify (Libero) and Gowin.
  (* ASYNC_REG = "TRUE" *)
  (* altera_attribute = "-name SYNCHRONIZER_IDENTIFICATION FORCED_IF_ASYNCHRONOUS" *)
  (* syn_preserve = 1, syn_replicate = 0 *)
  logic meta_q, settled_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {settled_q, meta_q} <= {2{can_pkg::Recessive}};
    else         {settled_q, meta_q} <= {meta_q, can_rx_i};
  end

  assign rx_o = settled_q;

endmodule
