  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Assumptions about the inputs of can_bsp, spliced into it before its properties.
  // The bus (bit_i), requests, frames and the stop request are free in every clock.

  // The bit: judge_i follows boundary_i; then one sample_i, then one boundary_i. Proven of
  // can_core as p_strobes_*.
  logic f_sampled;  // the bit has been sampled
  logic f_after_boundary;
  logic f_active;   // can_core.active_q
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)        {f_sampled, f_after_boundary, f_active} <= '0;
    else begin
      f_sampled        <= run_i && !boundary_i && (sample_i || f_sampled);
      f_after_boundary <= boundary_i;
      f_active         <= stay_i || (run_i && tx_o == can_pkg::Dominant);
    end
  end

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    // The first clock of a bit is the one after the boundary.
    m_judge: assume (judge_i == f_after_boundary);
    // One sample a bit, not in its first clock.
    m_sample: assume (!sample_i || (!f_sampled && !judge_i));
    // The bit ends after its sample.
    m_boundary: assume (!boundary_i || f_sampled);
    // A stop waits for a recessive level (can_core.active_q).
    m_run: assume (run_i == f_active);
    // Who has asked for a stop waits until the node has stopped. Proven of can_mode.
    m_stay: assume (!stay_i || $initstate || $past(stay_i || !run_i));
    // Strobes rest from the second stopped clock on.
    m_rest: assume (run_i || (rst_ni && $past(run_i)) || !(sample_i || boundary_i));
    // Modes change only while stopped.
    m_modes: assume (!run_i || $initstate || ({lom_i, lpb_i, fd_tolerant_i}
                     == $past({lom_i, lpb_i, fd_tolerant_i})));
    // In loop-back the node hears itself.
    m_loop: assume (!lpb_i || bit_i == tx_o);
  end

