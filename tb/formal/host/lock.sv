  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_mb_move beside can_mb_lock (lock_move.sv), spliced into it. The moment of
  // every read, write and frame is free, and so are the words of the RAM.

  logic f_ran, f_frame, f_moving_q, f_put, f_put_q, f_flag_fifo_q, f_ans_q;
  logic [IdxW-1:0] f_idx_q;
  // The C/S word is written (can_mb_step: step 3).
  logic f_cancel, f_copy;
  assign f_cancel = cs_written_i && cs_written_idx_i == idx_o;
  assign f_copy   = data_i && moving_o;
  assign f_put = data_i && step_o == 2'd3 && moving_o && !cancel_o;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_ran, f_frame, f_moving_q, f_put_q, f_flag_fifo_q, f_ans_q} <= '0;
      f_idx_q <= '0;
    end else begin
      f_ran         <= 1'b1;
      f_frame       <= start_i || (f_frame && !valid_i);
      f_moving_q    <= busy_mb_o;
      f_put_q       <= f_put && !clear_i;
      f_flag_fifo_q <= fifo;
      f_ans_q       <= ans;
      f_idx_q       <= idx_o;
    end
  end

  always @(posedge clk_i) begin
    // A frame is good only behind its begin.
    m_frame: assume (!(valid_i && (start_i || !f_frame)));
    if (rst_ni) begin
      // VA-01, flexcan.md 3.6: nothing waits in the hidden row that the frame on the bus is written
      // to, nor is anything moved from there, whenever matches, locks and moves end.
      p_own_row: assert (!f_frame || !(full_q[smb_o] || (mv_q && row_o == smb_o)));
      // flexcan.md 3.4: what is moved has not been cancelled.
      p_moves: assert (!mv_q || full_q[row_o]);
      // flexcan.md 3.6: no buffer is both locked and moved into, but in the clock after the
      // decision, in which nothing is written yet.
      p_not_both: assert (!(lock_i && busy_mb_o && lock_idx_i == idx_o) || (arm_q && !data_i));
      // flexcan.md 3.6: and so no word is written into a locked buffer.
      p_locked: assert (!(lock_i && busy_mb_o && lock_idx_i == idx_o && data_i));
      // flexcan.md 3.6: the first word comes after the decision: no step of a move that was
      // cancelled belongs to the next.
      p_own_steps: assert (!(arm_q && data_i));
      // flexcan.md 3.2: what a move leaves in the code: FULL, OVERRUN, or 1110 to be answered; in
      // the FIFO the number of the filter.
      p_code: assert (top_o[4:1] == 4'b0010 || top_o[4:1] == 4'b0110 || fifo
                      || (ans && top_o[4:1] == 4'b1110));
      // flexcan.md 3.4: a C/S write of the CPU cancels the move.
      p_cancel: assert (cancel == f_cancel);
      // flexcan.md 3.4: ... and no word is written to its buffer in that clock: of a step's data
      // the compare of the clock before is right.
      p_cancel_early: assert (!f_copy || cancel_o == f_cancel);
      if (f_ran) begin
        // flexcan.md 1.5, 3.2: IFLAG tells a frame stored in a mailbox, when its C/S word has been
        // written; nothing else does.
        p_flag: assert (flag_o == (f_put_q && !f_flag_fifo_q && !f_ans_q));
        // flexcan.md 1.5: ... and of the buffer it was written to.
        p_flag_idx: assert (!flag_o || idx_o == f_idx_q);
        // flexcan.md 4: a frame is told to the FIFO once it is there.
        p_stored: assert (stored_o == (f_put_q && f_flag_fifo_q));
        // flexcan.md 3.7: a request is told to the arbitration once the code is 1110.
        p_answer: assert (ans_o == (f_put_q && !f_flag_fifo_q && f_ans_q));
      end
    end
  end
