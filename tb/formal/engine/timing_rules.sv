  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Assumptions about the inputs of can_bit_timing, and what the rules make of an edge. Times are
  // in
  // quanta since the last sample point; nothing of the block's own position is used.

  always @(posedge clk_i) begin
    // Reset in the first clock, none later; the node runs.
    m_reset: assume (rst_ni == !$initstate);
    // Bit timing is constant while the node runs (BT-11); it is read in the stopped clocks before.
    m_config: assume ($initstate || {propseg_i, pseg1_i, pseg2_i, rjw_i, smp_i}
                      == $past({propseg_i, pseg1_i, pseg2_i, rjw_i, smp_i}));
    m_run: assume (run_i == f_started);
    // BT-03: SJW is at most PHASE_SEG1 and at most PHASE_SEG2.
    m_sjw: assume ({1'b0, rjw_i} <= pseg1_i && {1'b0, rjw_i} <= pseg2_i);
    // The level sent changes at bit boundaries (p_edges of bsp_always), to recessive in the first
    // bits.
    m_tx: assume ($initstate || tx_i == $past(tx_i) || $past(boundary_o));
  end

  logic [1:0] f_count;
  logic       f_started;
  assign f_started = f_count == 2'd2;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                f_count <= '0;
    else if (f_count != 2'd2)   f_count <= f_count + 2'd1;
  end

  logic [5:0] f_prop, f_ps1, f_ps2, f_sjw, f_nominal;
  assign f_prop    = {3'd0, propseg_i} + 6'd1;
  assign f_ps1     = {3'd0, pseg1_i} + 6'd1;
  assign f_ps2     = {3'd0, pseg2_i} + 6'd1;
  assign f_sjw     = {4'd0, rjw_i} + 6'd1;
  assign f_nominal = 6'd1 + f_prop + f_ps1 + f_ps2;

  // The edge that may synchronise, from the levels alone (SY-01..SY-03).
  logic       f_last_rx, f_last_sample, f_synced, f_hard_bit, f_known, f_boundary;
  logic [5:0] f_now;          // number of the current quantum since the last sample
  logic [5:0] f_due, f_due_next;  // quantum whose end is the next sample point
  logic [5:0] f_end;          // quantum whose end is the boundary
  logic       f_edge, f_hard;
  assign f_edge = run_i && f_last_rx && !rx_i && f_last_sample && !f_synced;
  assign f_hard = f_edge && f_hard_bit;

  // SY-06 to SY-10: what an edge in quantum f_now does to the next sample point.
  logic [5:0] f_late, f_early;
  assign f_late  = f_now - f_ps2 - 6'd1;
  assign f_early = f_ps2 + 6'd1 - f_now;
  always_comb begin
    f_due_next = f_due;
    if (f_hard)                               f_due_next = f_now + f_prop + f_ps1;
    else if (f_edge
        && f_now <= f_ps2)        f_due_next = f_nominal - (f_early < f_sjw ? f_early : f_sjw);
    else if (f_edge && f_now > f_ps2 && tx_i) f_due_next = f_nominal + (f_late < f_sjw ? f_late
        : f_sjw);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_last_rx, f_last_sample, f_synced, f_hard_bit, f_known, f_boundary} <= 6'b110100;
      {f_now, f_due, f_end} <= '0;
    end else if (run_i && tq_i) begin
      f_last_rx <= rx_i;
      f_now     <= f_now + 6'd1;
      f_due     <= f_due_next;
      if (f_edge)     f_synced <= 1'b1;
      if (boundary_o) begin
        f_hard_bit <= hard_i;
        f_boundary <= 1'b1;
      end
      if (sample_o) begin
        f_last_sample <= bit_o;
        f_synced      <= 1'b0;
        f_known       <= 1'b1;
        f_boundary    <= 1'b0;
        f_now         <= 6'd1;
        f_due         <= f_nominal;
      end
    end
  end

  logic [5:0] f_bound;
  assign f_bound = f_hard ? f_now
                   : f_edge && f_now <= f_ps2 ? (f_now > f_ps2 - f_sjw ? f_now : f_ps2 - f_sjw)
                       : f_ps2;
  logic [5:0] f_bound_q;
  logic       f_bound_set;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_bound_q, f_bound_set} <= '0;
    else if (run_i && tq_i) begin
      if (sample_o)                                     f_bound_set <= 1'b0;
      else if (f_edge && !f_boundary)  {f_bound_q, f_bound_set} <= {f_bound, 1'b1};
    end
  end

  logic f_synced_hard, f_hard_seen;
  assign f_synced_hard = f_hard_seen || f_hard;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)               f_hard_seen <= 1'b0;
    else if (run_i && tq_i)    f_hard_seen <= !sample_o && f_synced_hard;
  end
