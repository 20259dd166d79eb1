// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_stamp: decides when the stamp of a frame is taken (TM-20 to TM-26). Whether an edge is the
// stamped one is known only at a later sample point. Therefore every edge that may be the one is
// captured, and the last capture counts.

module can_stamp (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [1:0] point_i,       // TCTRL.POINT: 0 SOF, 2 EOF, else reference edge
  input  logic       txpin_i,       // TCTRL.TXPIN: 1: own frames at the receive pin as well
  // Levels in this clock.
  input  logic       rx_i,          // receive level, synchronised, behind loop-back
  input  logic       tx_i,          // own transmit level
  // Bit stream.
  input  logic       sample_i,      // sample point
  input  logic       bit_i,         // sampled bit
  input  can_pkg::field_t field_i,  // field of the current bit
  input  logic       transmitter_i, // this node sends the frame
  input  logic       sof_i,         // pulse in the clock after the sample point of a start of frame
  input  logic       rx_valid_i,    // pulse in the clock after the sample point of EOF6
  // Capture.
  output logic       take_o,        // TIME of this clock may be the stamp: capture it
  output logic       stamp_we_o,    // pulse: the last capture is the stamp of this frame; it is
                                    // kept until the next frame
  output logic       stamp_tx_o     // with stamp_we_o: stamp of an own frame
);
  localparam logic [1:0] PointSof = 2'd0;
  localparam logic [1:0] PointEof = 2'd2;

  logic [1:0] point_q;
  logic       txpin_q, rx_q, tx_q, last_q, fixed_q, told_q;
  logic       between, behind_id, at_sof, at_eof, at_edge;
  // The group bits of the field suffice.
  logic unused;
  assign unused = &{1'b0, field_i[2:0]};
  assign between   = !(|field_i[4:3]);
  assign behind_id = field_i[4] && !field_i[3];
  assign at_sof    = point_q == PointSof;
  assign at_eof    = point_q == PointEof;
  assign at_edge   = !at_sof && !at_eof;

  // TM-25: bits that this node sends are taken at its transmit flip-flop, unless TXPIN is 1; all
  // others at the receive pin.
  logic own, fall;
  assign own  = !txpin_q && transmitter_i && !between;
  assign fall = own ? tx_q && !tx_i : rx_q && !rx_i;

  // TM-21: the reference bit is the first one behind the arbitration field that is sampled dominant
  // after a recessive bit.
  logic reference;
  assign reference = sample_i && behind_id && !bit_i && last_q && at_edge;

  assign take_o     = at_eof ? rx_valid_i : fall && !fixed_q && !(at_sof && sof_i);
  assign stamp_tx_o = transmitter_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      point_q <= 2'd1;
      {txpin_q, fixed_q, told_q, stamp_we_o} <= '0;
      {rx_q, tx_q, last_q} <= '1;
    end else begin
      rx_q <= rx_i;
      tx_q <= tx_i;
      if (sample_i) last_q <= bit_i;
      if (between) {point_q, txpin_q} <= {point_i, txpin_i};

      fixed_q <= (at_sof && sof_i) || reference || (at_eof && rx_valid_i) || (fixed_q && !between);
      // Only after the arbitration field is it settled which node sends the frame.
      told_q     <= !between && (told_q || stamp_we_o);
      stamp_we_o <= fixed_q && (behind_id || at_eof) && !stamp_we_o && !told_q;
    end
  end
endmodule
