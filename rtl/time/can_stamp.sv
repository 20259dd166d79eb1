// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_stamp: when the time of a frame is taken (TM-20 to TM-26). An edge is known to be the right
// one only at a sample point behind it, so every edge that may be is taken, and the last one kept.

module can_stamp (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [1:0] point_i,       // TCTRL.POINT: 0 SOF, 2 EOF, else reference edge
  input  logic       txpin_i,       // TCTRL.TXPIN: 1: own frames at the own receive pin, too
  // Levels in this clock: synchronised receive level behind loop-back, own transmit level.
  input  logic       rx_i,
  input  logic       tx_i,
  // Bit stream; sof_i: pulse in the clock after the sample point of a start of frame.
  input  logic       sample_i,
  input  logic       bit_i,
  input  can_pkg::field_t field_i,
  input  logic       transmitter_i,
  input  logic       sof_i,
  input  logic       rx_valid_i,    // pulse in the clock after the sample point of EOF6
  // Capture.
  output logic       take_o,        // TIME of this clock may be the stamp
  output logic       stamp_we_o,    // pulse: what was taken last is the stamp of this frame; it is
                                    // kept until the next frame
  output logic       stamp_tx_o     // level, with it: an own frame
);
  localparam logic [1:0] PointSof = 2'd0;
  localparam logic [1:0] PointEof = 2'd2;

  logic [1:0] point_q;
  logic       txpin_q, rx_q, tx_q, last_q, fixed_q, told_q;
  logic       between, behind_id, at_sof, at_eof, at_edge;
  // The group of the field says enough.
  logic unused;
  assign unused = &{1'b0, field_i[2:0]};
  assign between   = !(|field_i[4:3]);
  assign behind_id = field_i[4] && !field_i[3];
  assign at_sof    = point_q == PointSof;
  assign at_eof    = point_q == PointEof;
  assign at_edge   = !at_sof && !at_eof;

  // The own flip-flop counts for bits that this node sends alone, its pin for all others.
  logic own, fall;
  assign own  = !txpin_q && transmitter_i && !between;
  assign fall = own ? tx_q && !tx_i : rx_q && !rx_i;

  // Reference bit: the first behind the arbitration field that is dominant behind a recessive one.
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
      // Whose frame it is, is settled after the arbitration field.
      told_q     <= !between && (told_q || stamp_we_o);
      stamp_we_o <= fixed_q && (behind_id || at_eof) && !stamp_we_o && !told_q;
    end
  end
endmodule
