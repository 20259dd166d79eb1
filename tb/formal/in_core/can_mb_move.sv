  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What host.lock assumes of the engine and of can_mb_match.

  logic f_frame;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_frame <= 1'b0;
    else         f_frame <= start_i || (f_frame && !valid_i);
  end

  always @(posedge clk_i) if (rst_ni) begin
    m_engine: assert (!(valid_i && (rx_hdr_i || start_i)) && !(rx_hdr_i && start_i));
    m_frame: assert (!(valid_i && (start_i || !f_frame)));
    m_match: assert (!(hit_fifo_i && hit_ans_i));
  end
