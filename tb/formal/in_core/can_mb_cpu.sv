  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What host.cpu_read assumes of can_mb_port.

  logic f_timer;
  assign f_timer = rd_done_i && mem_sel_i == 2'd3 && (rxfir_i || TimeUnit == 0);

  always @(posedge clk_i) if (rst_ni) begin
    m_word: assert (!rd_word_i || (rd_done_i && !mem_sel_i[1] && other_i == 32'd0));
    m_other: assert ((rd_done_i && mem_sel_i[1] && !f_timer) || other_i == 32'd0);
    m_end: assert (!end_i || rd_done_i || wr_done_i);
  end
