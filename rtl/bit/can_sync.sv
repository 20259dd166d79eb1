// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_sync: synchroniser of the CAN receive pin, two flip-flops. Its delay of one to two clocks
// counts as delay of the node (BT-06).

module can_sync (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic can_rx_i,  // receive pin, asynchronous
  output logic rx_o       // synchronised level; recessive after reset
);

  // The two flip-flops are to be placed side by side and must not be merged, duplicated or turned
  // into a shift register. The attributes are for Vivado, for Quartus, for Synplify (Libero) and
  // Gowin.
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
