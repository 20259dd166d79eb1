  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What host.port assumes of the other blocks of the buffers.

  logic       f_slot_q, f_wrote_q, f_mark, f_eng_cs_q;
  logic [2:0] f_read_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_slot_q, f_wrote_q, f_mark, f_eng_cs_q, f_read_q} <= '0;
    end else begin
      f_slot_q  <= eng_slot_o;
      f_wrote_q <= rx_wr_req_i;
      f_mark    <= rd_done_o || (f_mark && !serviced_gnt_o);
      f_read_q  <= {f_read_q[1:0], ins_gnt_o || (eng_slot_o && eng_req_i)};
      if (eng_slot_o) f_eng_cs_q <= eng_cs_i;
    end
  end

  always @(posedge clk_i) if (rst_ni) begin
    m_command: assert (!(cmd_rd_i && cmd_wr_i));
    m_copy: assert (!copy_i || (f_slot_q && !f_wrote_q));
    m_marks: assert (!serviced_req_i || f_mark);
    m_kind: assert (!copy_i || copy_cs_i == f_eng_cs_q);
    m_wish: assert (!eng_pass_i || eng_req_i || f_read_q != '0);
    m_hidden: assert (!rx_wr_req_i || (rx_wr_cs_i ? rx_wr_row_i[IdxW]
                                                  : rx_wr_row_i[IdxW+1:IdxW] == 2'd3));
    m_word: assert (!of_msg || word_q != 2'd3);
    m_ended: assert (!if_ended_i || (wr_done_o && !mem_sel_q[1]));
    m_row: assert (row_idx_i == idx_q || (idx_q == '0 && 7'(row_idx_i) < 7'd6));
  end
