// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_bit_timing: cuts time quanta into bits, synchronises to the bus and places the sample point.
// Rules BT-01..BT-10, SY-01..SY-21. A quantum is judged at its end: an edge seen there lies in it.

module can_bit_timing #(
  /// Width of the position: 5 for all timings; where they are fixed, enough for the longer of
  /// PROP_SEG + PHASE_SEG1 and PHASE_SEG2 + SJW.
  parameter int PosWidth = 5
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       run_i,        // 0: stopped in SYNC_SEG
  input  logic       tq_i,         // last clock of a time quantum
  input  logic       rx_i,         // settled bus level
  input  logic       tx_i,         // level this node sends in the current bit
  input  logic       hard_i,       // the next bit takes hard synchronisation (SY-05)
  input  logic [2:0] propseg_i,    // PROP_SEG - 1
  input  logic [2:0] pseg1_i,      // PHASE_SEG1 - 1
  input  logic [2:0] pseg2_i,      // PHASE_SEG2 - 1
  input  logic [1:0] rjw_i,        // SJW - 1
  input  logic       smp_i,        // majority of three samples (BT-10)
  output logic       sample_o,     // sample point: bit_o is the bit
  output logic       bit_o,
  output logic       boundary_o,   // last clock of the bit: the next level goes out
  output logic       edge_o        // recessive to dominant edge that synchronises
);
  if (PosWidth < 3 || PosWidth > 5) begin : gen_check_pos_width
    PosWidth_must_be_3_to_5 u_stop ();   // no such module: the tool prints the name and stops
  end

  logic       seg2_q;   // in PHASE_SEG2
  logic [PosWidth-1:0] pos_q;  // before the sample point: 0 = SYNC_SEG; in PHASE_SEG2: from 1
  logic       hard_q;   // the current bit takes hard synchronisation
  logic       armed_q;  // last sample recessive, no synchronisation since (SY-02, SY-03)
  logic [1:0] prev_q;   // levels at the two preceding quanta

  // Registers, for they are constant and slow: PROP_SEG + PHASE_SEG1, and from which position in
  // PHASE_SEG2 on an early edge ends the bit
  logic [PosWidth-1:0] tseg1_q;
  logic [2:0]          reach_q;
  logic [PosWidth-1:0] tseg2, sjw, ahead;
  logic       falling, hard, late, early, over, guard;

  localparam logic [PosWidth-1:0] One = PosWidth'(1);

  assign tseg2 = PosWidth'({2'b0, pseg2_i} + 5'd1);
  assign sjw   = PosWidth'({3'b0, rjw_i} + 5'd1);

  assign falling = armed_q && prev_q[0] && !rx_i;                  // SY-01
  assign hard    = falling && hard_q;                              // SY-06
  // Positive phase error: not for a node that sends dominant (SY-10); zero in SYNC_SEG (SY-07).
  assign late    = falling && tx_i && (pos_q != '0);
  assign early   = falling && seg2_q;

  // Position after this quantum: a late edge sets the count back, which lengthens PHASE_SEG1; an
  // early one sets it forward, which shortens PHASE_SEG2; both by at most SJW (SY-08).
  assign ahead      = early ? pos_q + sjw : pos_q;
  // Does PHASE_SEG2 end with it? As ahead >= tseg2, but without an adder behind the edge.
  assign over       = falling ? pos_q >= PosWidth'(reach_q) : pos_q > PosWidth'(pseg2_i);
  // An edge in the last quantum of PHASE_SEG1 still comes before the sample point and moves it.
  assign guard      = armed_q && prev_q[0] && (hard_q || tx_i);
  assign sample_o   = tq_i && !seg2_q && (pos_q == tseg1_q) && (rx_i || !guard);
  assign boundary_o = tq_i && seg2_q && (over || hard);
  assign edge_o     = tq_i && falling;
  assign bit_o      = smp_i ? (rx_i && prev_q[0]) || (rx_i && prev_q[1]) || (&prev_q) : rx_i;

  // Loaded in every clock, so that an upset does not last until the next stop.
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

      // The quantum that holds a hard edge, or an early one within SJW, is the new SYNC_SEG.
      if (sample_o || hard)                pos_q <= One;
      else if (seg2_q && over)             pos_q <= PosWidth'(ahead != tseg2);
      else if (seg2_q)                     pos_q <= ahead + One;
      else if (late)                       pos_q <= (pos_q > sjw) ? pos_q + One - sjw : One;
      // Beyond the sample point by an upset flip-flop: sampled with the next quantum.
      else                                 pos_q <= (pos_q >= tseg1_q) ? tseg1_q : pos_q + One;
    end
  end

endmodule
