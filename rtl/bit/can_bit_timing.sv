// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_bit_timing: bit timing logic. It divides the stream of time quanta into bits, synchronises to
// the edges of the bus and places the sample point. Rules BT-01..BT-10, SY-01..SY-21. A quantum is
// evaluated in its last clock: an edge seen there belongs to that quantum.

module can_bit_timing #(
  /// Width of the position counter. 5 suits all timings; for a fixed timing it has to hold the
  /// longer of PROP_SEG + PHASE_SEG1 and PHASE_SEG2 + SJW.
  parameter int PosWidth = 5
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       run_i,        // 0: stopped in SYNC_SEG
  input  logic       tq_i,         // pulse: last clock of a time quantum
  input  logic       rx_i,         // bus level, synchronised
  input  logic       tx_i,         // level this node sends in the current bit
  input  logic       hard_i,       // the next bit uses hard synchronisation (SY-05)
  input  logic [2:0] propseg_i,    // PROP_SEG - 1
  input  logic [2:0] pseg1_i,      // PHASE_SEG1 - 1
  input  logic [2:0] pseg2_i,      // PHASE_SEG2 - 1
  input  logic [1:0] rjw_i,        // SJW - 1
  input  logic       smp_i,        // 1: majority of three samples (BT-10)
  output logic       sample_o,     // pulse: sample point, bit_o is the bit
  output logic       bit_o,        // sampled level, with sample_o
  output logic       boundary_o,   // pulse: last clock of the bit, the next level goes out
  output logic       edge_o        // pulse: recessive to dominant edge that synchronises
);
  if (PosWidth < 3 || PosWidth > 5) begin : gen_check_pos_width
    PosWidth_must_be_3_to_5 u_stop ();   // no such module: the tool prints the name and stops
  end

  logic       seg2_q;   // position is in PHASE_SEG2
  logic [PosWidth-1:0] pos_q;  // quantum: 0 is SYNC_SEG; restarts at 1 in PHASE_SEG2
  logic       hard_q;   // the current bit uses hard synchronisation
  logic       armed_q;  // last sample recessive, no synchronisation since (SY-02, SY-03)
  logic [1:0] prev_q;   // levels at the two previous quanta

  // PROP_SEG + PHASE_SEG1, and the position in PHASE_SEG2 from which on an early edge ends the bit.
  // Both are constant while running and are registered to keep their adders off the critical path.
  logic [PosWidth-1:0] tseg1_q;
  logic [2:0]          reach_q;
  logic [PosWidth-1:0] tseg2, sjw, ahead;
  logic       falling, hard, late, early, over, guard;

  localparam logic [PosWidth-1:0] One = PosWidth'(1);

  assign tseg2 = PosWidth'({2'b0, pseg2_i} + 5'd1);
  assign sjw   = PosWidth'({3'b0, rjw_i} + 5'd1);

  assign falling = armed_q && prev_q[0] && !rx_i;                  // SY-01
  assign hard    = falling && hard_q;                              // SY-06
  // Positive phase error. It is ignored while this node sends dominant (SY-10), and 0 in SYNC_SEG
  // (SY-07).
  assign late    = falling && tx_i && (pos_q != '0);
  assign early   = falling && seg2_q;

  // Position after this quantum. A late edge sets it back, which lengthens PHASE_SEG1; an early
  // edge advances it, which shortens PHASE_SEG2; both by SJW at most (SY-08).
  assign ahead      = early ? pos_q + sjw : pos_q;
  // 1: PHASE_SEG2 ends with this quantum. As ahead >= tseg2, but without an adder after the edge.
  assign over       = falling ? pos_q >= PosWidth'(reach_q) : pos_q > PosWidth'(pseg2_i);
  // An edge in the last quantum of PHASE_SEG1 is before the sample point and therefore moves it.
  assign guard      = armed_q && prev_q[0] && (hard_q || tx_i);
  assign sample_o   = tq_i && !seg2_q && (pos_q == tseg1_q) && (rx_i || !guard);
  assign boundary_o = tq_i && seg2_q && (over || hard);
  assign edge_o     = tq_i && falling;
  assign bit_o      = smp_i ? (rx_i && prev_q[0]) || (rx_i && prev_q[1]) || (&prev_q) : rx_i;

  // Loaded in every clock, so that an upset is corrected at once.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tseg1_q <= PosWidth'(2);
      reach_q <= '0;
    end else begin
      tseg1_q <= PosWidth'({2'b0, propseg_i} + {2'b0, pseg1_i} + 5'd2);
      reach_q <= {1'b0, rjw_i} < pseg2_i ? pseg2_i - {1'b0, rjw_i} : 3'd0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      seg2_q  <= 1'b0;
      pos_q   <= '0;
      hard_q  <= 1'b1;
      armed_q <= 1'b1;
      prev_q  <= 2'b11;
    end else if (!run_i) begin
      seg2_q  <= 1'b0;
      pos_q   <= '0;
      hard_q  <= 1'b1;
      armed_q <= 1'b1;
      prev_q  <= 2'b11;
    end else if (tq_i) begin
      prev_q <= {prev_q[0], rx_i};
      if (sample_o)     armed_q <= bit_o;
      else if (falling) armed_q <= 1'b0;
      if (boundary_o)   hard_q  <= hard_i;
      if (sample_o || boundary_o) seg2_q <= sample_o;

      // A quantum with a hard edge, or with an early edge within SJW, becomes the new SYNC_SEG.
      if (sample_o || hard)                pos_q <= One;
      else if (seg2_q && over)             pos_q <= PosWidth'(ahead != tseg2);
      else if (seg2_q)                     pos_q <= ahead + One;
      else if (late)                       pos_q <= (pos_q > sjw) ? pos_q + One - sjw : One;
      // A position beyond the sample point is due to an upset: sample at the next quantum.
      else                                 pos_q <= (pos_q >= tseg1_q) ? tseg1_q : pos_q + One;
    end
  end

endmodule
