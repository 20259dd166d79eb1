  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What host.port assumes of the bytes of the frame being received.

  logic f_came_q, f_wrote_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_came_q, f_wrote_q} <= '0;
    else         {f_came_q, f_wrote_q} <= {rx_byte_we_i, rx_wr_req};
  end

  always @(posedge clk_i) if (rst_ni) begin
    m_copy: assert (!copy || !f_came_q);
    m_byte: assert (!f_came_q || rx_wr_req);
    m_alone: assert (!f_came_q || !f_wrote_q);
  end
