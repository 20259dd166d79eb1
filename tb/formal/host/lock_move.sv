// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_lock and can_mb_move as can_mailbox connects them, with free surroundings: the CPU's reads
// and writes, the match, the frames, and the RAM's words.

module lock_move (
  input  logic        clk_i, rst_ni, clear_i, bcc_i, cs_rd_i, timer_rd_i, cs_written_i,
    cs_written_empty_i,
  input  logic        start_i, rx_hdr_i, valid_i, hold_i, match_done_i, hit_i, hit_fifo_i,
  input  logic        hit_ans_i, grant_i, serviced_gnt_i,
  input  logic [3:0]  idx_i, cs_written_idx_i, hit_idx_i,
  input  logic [8:0]  idhit_i,
  input  logic [31:0] cpu_cs_i, cs_i,
  output logic        flag_o, stored_o, ans_o, busy_o
);
  logic       lock, serviced_req, serviced_ovr, smb, resolve, req, row, cancel, moving, busy_mb,
    busy_idx;
  logic [3:0] lock_idx, serviced_idx, idx;
  logic [1:0] step;
  logic [8:0] top;

  // can_mb_step: the data of a step is there in the clock after its grant, and no step in between.
  logic data_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) data_q <= 1'b0;
    else         data_q <= req && grant_i && !data_q;
  end

  assign busy_idx = busy_mb && idx == idx_i;
  can_mb_lock #(.NumMb(16)) u_lock (
    .clk_i, .rst_ni, .clear_i, .bcc_i, .cs_rd_i, .timer_rd_i, .idx_i, .cs_i(cpu_cs_i),
    .busy_i(busy_idx), .cs_written_i, .cs_written_idx_i, .lock_o(lock), .lock_idx_o(lock_idx),
    .serviced_req_o(serviced_req), .serviced_idx_o(serviced_idx), .serviced_ovr_o(serviced_ovr),
    .serviced_gnt_i(serviced_gnt_i && serviced_req));

  can_mb_move #(.NumMb(16)) u_move (
    .clk_i, .rst_ni, .clear_i, .start_i, .rx_hdr_i, .valid_i, .hold_i(hold_i || serviced_req),
    .smb_o(smb), .match_done_i, .hit_i, .hit_idx_i, .hit_fifo_i, .hit_ans_i, .idhit_i,
    .resolve_o(resolve), .lock_i(lock), .lock_idx_i(lock_idx), .cs_written_i, .cs_written_idx_i,
    .cs_written_empty_i,
    .req_o(req), .step_o(step), .row_o(row), .idx_o(idx), .data_i(data_q && moving), .cs_i,
    .top_o(top), .cancel_o(cancel), .moving_o(moving), .busy_mb_o(busy_mb), .flag_o, .stored_o,
    .ans_o, .busy_o);

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    // The engine tells of a good frame a field after its header, of a header after the start.
    m_engine: assume (!(valid_i && (rx_hdr_i || start_i)) && !(rx_hdr_i && start_i));
    // can_mb_match: an answer is looked for only where no frame goes into the FIFO.
    m_match: assume (!(hit_fifo_i && hit_ans_i));
  end
endmodule
