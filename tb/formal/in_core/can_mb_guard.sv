  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What host.guard assumes of can_mb_port and can_mb_load.

  logic            f_second;
  logic [1:0]      f_mem_sel;
  logic [IdxW-1:0] f_idx;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_second, f_mem_sel, f_idx} <= '0;
    else         {f_second, f_mem_sel, f_idx} <= {first_i, mem_sel_i, idx_i};
  end

  always @(posedge clk_i) if (rst_ni) begin
    m_clocks: assert (wr_done_i == f_second && !(first_i && f_second));
    m_held: assert (!f_second || (mem_sel_i == f_mem_sel && idx_i == f_idx));
    m_done: assert (out_i || !done_i);
  end
