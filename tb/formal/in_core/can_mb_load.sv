  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What host.load assumes of can_mb_port and can_mb_cpu: a C/S write is told in the clock behind
  // its second one.

  logic            f_wr, f_second;
  logic [IdxW-1:0] f_idx;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_wr, f_second, f_idx} <= '0;
    else         {f_wr, f_second, f_idx} <= {cs_wr_i, cmd_i, cs_wr_idx_i};
  end

  always @(posedge clk_i) if (rst_ni) begin
    m_written: assert (!cs_written_i || (f_wr && f_second && f_idx == cs_written_idx_i));
    m_ends: assert (!running_i || !(tx_ok_i || tx_fail_i) || on_bus_q);
  end
