// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_mask: the global mask in use, for a core without a memory of masks (OwnMasks = 0). It is
// read from the MSG memory before the first comparison that needs it: at the beginning of a pass,
// and before buffers 14, 15 and 16.

module can_mb_mask (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,      // a new frame: masks may have been written since
  input  logic        req_i,        // a comparison wants a read slot
  input  logic [1:0]  want_i,       // under RXGMASK (0), RX14MASK, RX15MASK, RXFGMASK (3)
  input  logic        all_i,        // ... or under a mask of ones
  output logic        req_o,
  output logic        load_o,       // the slot is for a mask: row want_i
  input  logic        gnt_i,
  output logic        gnt_o,        // the slot is for the comparison
  input  logic [31:0] msg_i,
  output logic [31:0] mask_o
);
  logic       valid_q, data_q;      // the mask is there; it is on the RAM outputs
  logic [1:0] which_q;
  assign load_o = !valid_q || which_q != want_i;
  assign req_o  = req_i && !data_q;
  assign gnt_o  = gnt_i && !load_o;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {valid_q, data_q} <= '0;
      which_q <= '0;
      mask_o  <= '0;
    end else begin
      data_q <= gnt_i && load_o;
      if (gnt_i && load_o) which_q <= want_i;
      if (data_q) mask_o <= msg_i | {32{all_i}};
      valid_q <= !clear_i && (data_q || (valid_q && !(gnt_i && load_o)));
    end
  end
endmodule
