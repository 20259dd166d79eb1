  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Property of can_mb_load, spliced into it: from every content of its flip-flops the active
  // buffer f_a, winner of the arbitration, is sent and told. There is no reset here.

  localparam int FBound = 60;
  (* anyconst *) logic [IdxW-1:0] f_a;
  logic [6:0] f_t = 7'd0;
  logic       f_told = 1'b0;
  always @(posedge clk_i) begin
    f_t <= f_t == 7'(FBound) ? f_t : f_t + 7'd1;
    if (sent_o && cur_idx_o == f_a) f_told <= 1'b1;
  end

  // An engine that takes a frame after two clocks of gap and has sent it after eight; in any state
  // at first. Its first word goes with the start.
  logic [3:0] f_bit;
  logic       f_busy, f_take, f_start_q, f_ok_q;
  assign f_take = !f_busy && tx_req_o && f_bit >= 4'd2;
  always @(posedge clk_i) begin
    f_start_q <= f_take;
    f_ok_q    <= f_busy && f_bit == 4'd8;
    if (f_take)                        {f_busy, f_bit} <= {1'b1, 4'd0};
    else if (f_busy && f_bit >= 4'd8)  {f_busy, f_bit} <= {1'b0, 4'd0};
    else if (f_bit != 4'd15)           f_bit <= f_bit + 4'd1;
  end
  // Steps are granted at once, their data is there in the next clock; no two in a row.
  logic       f_data_q;
  logic [2:0] f_step_q;
  always @(posedge clk_i) begin
    f_data_q <= req_o && !f_data_q;
    f_step_q <= step_o;
  end

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    m_mode: assume (running_i && !mute_i && !oneshot_i && !aen_i && !abort_i);
    m_cpu: assume (!cs_written_i && !cs_wr_i);
    m_winner: assume (settled_i && best_idx_i == f_a && !retry_busy_i);
    m_gap: assume (gap_i == !f_busy && transmitter_i == f_busy);
    m_engine: assume (start_i == f_start_q && tx_next_i == f_start_q && tx_ok_i == f_ok_q
                      && !tx_fail_i);
    // A sample point now and then, at which a waiting frame may be replaced.
    m_tick: assume (tick_i == (f_t[1:0] == 2'd0));
    m_steps: assume (data_i == f_data_q && flight_i == f_data_q && data_step_i == f_step_q);
    m_active: assume ((cs_i[27:24] == 4'b1100) == (ld_idx_o == f_a) && cs_i[27:24] != 4'b1110);
    // FX-9.e3407: the transmitter never stalls: the frame is sent and its end told.
    p_sent: assert (f_t != 7'(FBound) || f_told);
  end
