  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What bsp_inputs.sv assumes of can_bit_timing, can_core and can_mode.

  logic       f_ran, f_sampled, f_after_boundary, f_active, f_run, f_stay;
  logic [2:0] f_modes;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_ran, f_sampled, f_after_boundary, f_active, f_run, f_stay} <= '0;
      f_modes <= '0;
    end else begin
      f_ran            <= 1'b1;
      f_sampled        <= run_i && !boundary_i && (sample_i || f_sampled);
      f_after_boundary <= boundary_i;
      f_active         <= stay_i || (run_i && tx_o == can_pkg::Dominant);
      f_run            <= run_i;
      f_stay           <= stay_i || !run_i;
      f_modes          <= {lom_i, lpb_i, fd_tolerant_i};
    end
  end

  always @(posedge clk_i) if (rst_ni) begin
    m_judge: assert (judge_i == f_after_boundary);
    m_sample: assert (!sample_i || (!f_sampled && !judge_i));
    m_boundary: assert (!boundary_i || f_sampled);
    m_run: assert (!f_ran || run_i == f_active);
    m_stay: assert (!stay_i || !f_ran || f_stay);
    m_rest: assert (run_i || f_run || !(sample_i || boundary_i));
    m_modes: assert (!run_i || !f_ran || {lom_i, lpb_i, fd_tolerant_i} == f_modes);
    m_loop: assert (!lpb_i || bit_i == tx_o);
  end
