  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_bit_timing for every configuration, every bus and every moment of the quanta.

  always @(posedge clk_i) if (rst_ni && run_i) begin
    if (f_known) begin
      // BT-05, SY-08, SY-09, SY-13: the bit ends in its quantum, in no other.
      p_boundary: assert (boundary_o == (tq_i && !f_boundary
                          && f_now == (f_bound_set ? f_bound_q : f_bound)));
    end
    // BT-05: what is decided a quantum ahead is what the position says. In the last quantum of
    // PHASE_SEG1 a recessive level is sampled.
    p_due: assert (due_q == (!seg2_q && {1'b0, pos_q} == f_prop + f_ps1));
    // SY-08, SY-10: so is a dominant one, if it is no edge that moves the sample point.
    p_due_d: assert (due_d_q == (due_q && !(armed_q && prev_q[0] && (hard_q || tx_i))));
    // SY-06, SY-08: an edge in PHASE_SEG2 ends the bit if SJW reaches its end, or if it is hard.
    p_near: assert (near_q == (seg2_q && armed_q && prev_q[0]
                               && (hard_q || {1'b0, pos_q} + f_sjw >= f_ps2)));
    // BT-05: without one the bit ends with the last quantum.
    p_end: assert (end_q == (seg2_q && {1'b0, pos_q} == f_ps2));
    // SY-01, SY-02, SY-03: one recessive to dominant edge a bit synchronises, after a recessive
    // bit.
    p_one_sync: assert (edge_o == (tq_i && f_edge));
    // BT-10: one sample, or the majority of three.
    p_majority: assert (bit_o == (smp_i ? ({1'b0, rx_i} + {1'b0, prev_q[0]} + {1'b0, prev_q[1]}
        >= 2'd2)
                                        : rx_i));
    // BT-01, BT-05: one sample point, then one boundary; no sample in the first clock of a bit.
    p_one_sample: assert (!sample_o || !f_known || f_boundary);
    p_one_boundary: assert (!boundary_o || (f_known && !f_boundary));
    p_not_first: assert (!sample_o || $initstate || !$past(boundary_o));
  end
