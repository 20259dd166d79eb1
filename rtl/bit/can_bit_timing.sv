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

  // What the position means, decided with it in the quantum before: the longest paths of the core
  // begin here, and without this they would begin with comparisons.
  logic       due_q;    // last quantum of PHASE_SEG1: a recessive level is sampled
  logic       due_d_q;  // a dominant level, too, because it is no edge
  logic       near_q;   // in PHASE_SEG2: a dominant level is an edge that ends the bit
  logic       end_q;    // last quantum of PHASE_SEG2

  // Constant while running, and registered to keep the adders off these paths. A position from
  // which the next one is the last of PHASE_SEG1, or is within SJW of the end of PHASE_SEG2.
  logic [PosWidth-1:0] tseg1_q;  // PROP_SEG + PHASE_SEG1 - 1
  logic [2:0]          reach_q;  // PHASE_SEG2 - 1 - SJW, at least 0
  logic [PosWidth-1:0] sjw, step;
  logic       falling, hard, late, early, due, reached, sampling, ending, clipped;

  localparam logic [PosWidth-1:0] One = PosWidth'(1);

  assign sjw = PosWidth'({3'b0, rjw_i} + 5'd1);

  assign falling = armed_q && prev_q[0] && !rx_i;                  // SY-01
  assign hard    = falling && hard_q;                              // SY-06
  // Positive phase error. It is ignored while this node sends dominant (SY-10), and 0 in SYNC_SEG
  // (SY-07).
  assign late    = falling && tx_i && !seg2_q && (pos_q != '0);
  assign early   = falling && seg2_q;

  assign sampling   = rx_i ? due_q : due_d_q;
  assign ending     = end_q || (near_q && !rx_i);
  assign sample_o   = tq_i && sampling;
  assign boundary_o = tq_i && ending;
  assign edge_o     = tq_i && falling;
  assign bit_o      = smp_i ? (rx_i && prev_q[0]) || (rx_i && prev_q[1]) || (&prev_q) : rx_i;

  // Position after this quantum. A late edge sets it back, which lengthens PHASE_SEG1; an early
  // edge advances it, which shortens PHASE_SEG2; both by SJW at most (SY-08).
  assign step    = early ? sjw : late ? ~(PosWidth'(rjw_i)) : '0;
  assign clipped = late && pos_q <= PosWidth'(rjw_i);
  // The next position is within SJW of the end.
  assign reached = pos_q >= PosWidth'(reach_q);

  // Loaded in every clock, so that an upset is corrected at once.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tseg1_q <= One;
      reach_q <= '0;
    end else begin
      tseg1_q <= PosWidth'({2'b0, propseg_i} + {2'b0, pseg1_i} + 5'd1);
      reach_q <= {1'b0, rjw_i} < pseg2_i ? pseg2_i - {1'b0, rjw_i} - 3'd1 : 3'd0;
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
      if (sampling)     armed_q <= bit_o;
      else if (falling) armed_q <= 1'b0;
      if (ending)       hard_q  <= hard_i;
      if (sampling || ending) seg2_q <= sampling;

      // A quantum with a hard edge, or with an early edge within SJW, becomes the new SYNC_SEG.
      if (sampling || hard || clipped) pos_q <= One;
      else if (ending)                 pos_q <= PosWidth'(early && pos_q + PosWidth'(rjw_i)
                                                                   != PosWidth'(pseg2_i));
      else                             pos_q <= pos_q + step + One;
    end
  end

  // An edge in the last quantum of PHASE_SEG1 is before the sample point and therefore moves it. A
  // position beyond that quantum is due to an upset: sample at the next one.
  assign due = !sampling && !hard && !seg2_q && (late ? due_q && rjw_i == '0 : pos_q >= tseg1_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)     {due_q, due_d_q, near_q, end_q} <= '0;
    else if (!run_i) {due_q, due_d_q, near_q, end_q} <= '0;
    else if (tq_i) begin
      due_q   <= due;
      due_d_q <= due && !(rx_i && armed_q && (hard_q || tx_i));
      if (sampling) begin
        near_q <= rx_i && bit_o && (hard_q || reach_q == '0);
        end_q  <= pseg2_i == '0;
      end else begin
        near_q <= rx_i && armed_q && seg2_q && !ending && (hard_q || reached);
        end_q  <= seg2_q && !ending && (falling ? reached : pos_q >= PosWidth'(pseg2_i));
      end
    end
  end

endmodule
