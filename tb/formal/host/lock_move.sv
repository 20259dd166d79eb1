// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_lock, can_mb_move and can_mb_step as can_mailbox connects them, with free surroundings:
// the CPU's reads and writes, the match, the frames, the loads, and the RAM's words.

module lock_move (
  input  logic        clk_i, rst_ni, clear_i, bcc_i, cpu_go_i, cpu_wr_i, cpu_cs_i, cpu_timer_i,
    cpu_be3_i, cpu_off_i,
  input  logic        start_i, rx_hdr_i, valid_i, hold_i, match_done_i, hit_i, hit_fifo_i,
  input  logic        hit_ans_i, slot_i, yield_i, ld_req_i, ld_cancel_i, serviced_i,
    serviced_gnt_i,
  input  logic [2:0]  ld_step_i,
  input  logic [3:0]  cpu_idx_i, code_i, hit_idx_i,
  input  logic [8:0]  idhit_i,
  input  logic [31:0] cs_i, word_i,
  output logic        flag_o, stored_o, ans_o, busy_o
);
  logic       lock, serviced_req, serviced_ovr, smb, resolve, req, row, cancel, moving, busy_mb,
    busy_idx, answer, data;
  logic [3:0] lock_idx, serviced_idx, idx;
  logic [1:0] step;
  logic [8:0] top;

  // can_mb_port, can_mb_cpu: an access takes two clocks; in the second of a read its word is there,
  // in that of a write the RAM is written, or not (cpu_off_i).
  logic       first_q, second_q, wr_q, cs_q, timer_q, be3_q, cs_rd, timer_rd, cs_written_q;
  logic [3:0] idx_q, cs_written_idx_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {first_q, second_q, wr_q, cs_q, timer_q, be3_q, cs_written_q} <= '0;
      {idx_q, cs_written_idx_q} <= '0;
    end else begin
      first_q  <= !first_q && cpu_go_i;
      second_q <= first_q;
      if (!first_q) begin
        {wr_q, cs_q, timer_q, be3_q} <= {cpu_wr_i, cpu_cs_i, cpu_timer_i, cpu_be3_i};
        idx_q <= cpu_idx_i;
      end
      cs_written_q <= second_q && wr_q && cs_q && !cpu_off_i;
      if (second_q) cs_written_idx_q <= idx_q;
    end
  end
  assign cs_rd    = second_q && !wr_q && cs_q;
  assign timer_rd = second_q && !wr_q && !cs_q && timer_q;

  assign busy_idx = busy_mb && idx == idx_q;
  can_mb_lock #(.NumMb(16)) u_lock (
    .clk_i, .rst_ni, .clear_i, .bcc_i, .cs_rd_i(cs_rd), .timer_rd_i(timer_rd), .idx_i(idx_q),
    .be3_i(be3_q), .code_i, .serviced_i, .busy_i(busy_idx), .cs_written_i(cs_written_q),
    .cs_written_idx_i(cs_written_idx_q), .lock_o(lock), .lock_idx_o(lock_idx),
    .serviced_req_o(serviced_req), .serviced_idx_o(serviced_idx), .serviced_ovr_o(serviced_ovr),
    .serviced_gnt_i(serviced_gnt_i && serviced_req));

  can_mb_move #(.NumMb(16)) u_move (
    .clk_i, .rst_ni, .clear_i, .start_i, .rx_hdr_i, .valid_i, .hold_i(hold_i || serviced_req),
    .smb_o(smb), .match_done_i, .hit_i, .hit_idx_i, .hit_fifo_i, .hit_ans_i, .idhit_i,
    .resolve_o(resolve), .lock_i(lock), .lock_idx_i(lock_idx), .cs_written_i(cs_written_q),
    .cs_written_idx_i(cs_written_idx_q), .cpu_idx_i(idx_q),
    .req_o(req), .step_o(step), .row_o(row), .idx_o(idx), .data_i(data), .cs_i,
    .top_o(top), .cancel_o(cancel), .moving_o(moving), .busy_mb_o(busy_mb), .answer_o(answer),
    .flag_o, .stored_o, .ans_o, .busy_o);

  can_mb_step #(.NumMb(16)) u_step (
    .clk_i, .rst_ni, .ld_req_i, .ld_step_i, .ld_row_i(1'b0), .ld_word_i(1'b0), .ld_idx_i(4'd0),
    .cur_idx_i(4'd0), .ld_cancel_i, .ld_code_i(4'd0),
    .mv_req_i(req), .mv_step_i(step), .mv_row_i(row), .mv_idx_i(idx), .moving_i(moving),
    .mv_answer_i(answer), .mv_cancel_i(cancel), .mv_top_i(top), .mv_data_o(data),
    .rx_req_i(1'b0), .rx_idx_i(4'd0), .rx_word_i(2'd0), .rx_cs_i(1'b0),
    .rx_mask_row_i(5'd0), .scan_req_i(1'b0), .scan_lazy_i(1'b0), .scan_idx_i(4'd0),
    .slot_i, .yield_i, .word_i);

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    // The engine tells of a good frame a field after its header, of a header after the start.
    m_engine: assume (!(valid_i && (rx_hdr_i || start_i)) && !(rx_hdr_i && start_i));
    // can_mb_match: an answer is looked for only where no frame goes into the FIFO.
    m_match: assume (!(hit_fifo_i && hit_ans_i));
  end
endmodule
