// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_mask: holds the global mask in use in a core without a memory of masks (OwnMasks = 0). The
// mask is read from the MSG memory in a slot of its own before the first comparison that needs it:
// at the beginning of a pass, and before buffers 14, 15 and 16.

module can_mb_mask (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,      // pulse, a new frame: masks may have been written since
  input  logic        req_i,        // 1: a comparison wants a read slot
  input  logic [1:0]  want_i,       // mask of the comparison, can_mb_pkg::RowRxgmask to RowRxfgmask
  input  logic        all_i,        // 1: the comparison needs a mask of ones instead
  output logic        req_o,        // 1: a read slot is wanted, for a comparison or a mask
  output logic        load_o,       // 1: the slot is for mask want_i
  input  logic        gnt_i,        // 1: slot granted; data in the next clock
  output logic        gnt_o,        // 1: the slot is for the comparison
  input  logic [31:0] msg_i,        // MSG word on the RAM outputs
  output logic [31:0] mask_o        // mask in use
);
  // valid_q: mask_o is mask which_q; data_q: that mask is on the RAM outputs.
  logic       valid_q, data_q;
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
