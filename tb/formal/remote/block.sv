  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_block, spliced into it: any frames, any jobs, any content of the RAM.

  // What an op opens, and what has ended it, until its answer is in the queue.
  logic f_ran, f_flushed, f_abort, f_late;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_ran, f_flushed, f_abort, f_late} <= '0;
    else begin
      f_ran     <= 1'b1;
      f_flushed <= flush_i;
      f_abort   <= !flush_i && (aborts || (f_abort && !close));
      f_late    <= !flush_i && (timeout_o || (f_late && !close));
    end
  end

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    // BLOCK is refused while one is open, and with an op above 2 (can_rn_check).
    m_open: assume (!open || (!busy_o && (op_i == 2'd1 || op_i == 2'd2)));
    // JobClose ends a transfer: it is asked for, or follows a frame that is refused or JobAdd.
    m_close: assume (!close || read_q || write_q);
    // One job after the other; a frame is either made or received.
    m_push: assume (!push || !live_i);
    if (f_ran) begin
      // RN-42: one transfer at a time.
      p_one: assert (!(read_q && write_q));
      // RN-42: bus-off, RESTART and ASSIGN end whatever is open and what is owed for it.
      p_flush: assert (!f_flushed || !(busy_o || open_q || advance_q || close_q));
      // RN-41, RN-42: what is open is busy, so that the next BLOCK is refused.
      p_busy: assert (busy_o || !(read_q || write_q || answer_q));
      // RN-42: each end is answered.
      p_answer: assert (!$past(close && !flush_i) || answer_q);
      // RN-42: and what has ended is open no more, but for the answer that opens a write.
      p_closed: assert (!$past(close && !flush_i && !open_q) || !(read_q || write_q));
      p_opened: assert (!$past(close && !flush_i && open_q && write_q) || write_q);
      // RN-42, RN-31: the code of an abort and of a time-out.
      p_aborted: assert (!(close && f_abort && !nothing_left && !late_q && !open_q)
                         || code_o == can_rn_pkg::CodeAborted);
      p_late: assert (!(close && f_late && !open_q) || code_o == can_rn_pkg::CodeTimeout);
      // RN-42: a time-out and an abort close.
      p_ends: assert (!$past((timeout_o || aborts) && !flush_i && !close) || close_q);
      // RN-41: a frame is the next, or the last again, of a write alone, and never both.
      p_order: assert (!(order_o || again_o || part_o || over_o) || write_q);
      // RN-41: again means that one has been taken.
      p_again: assert (!again_o || any_q);
      // RN-40: a frame of data is made for a read whose pause is over, into an empty queue.
      p_made: assert (!(want_o && next_o == can_rn_pkg::JobFetch) || answer_q
                      || (read_q && !waiting_q && !some_i));
      // RN-42: the answer is made only where there is room.
      p_room: assert (!(want_o && next_o == can_rn_pkg::JobFetch && answer_q) || !full_i);
      // RN-07, RN-42: nothing is made off the bus or without a number.
      p_ready: assert (!(want_o && next_o == can_rn_pkg::JobFetch) || ready_i);
      // RN-41: what was moved is added as it was, whatever the engine shows meanwhile.
      p_moved: assert (!$past(advance_q) || moved_q == $past(moved_q));
      // RN-40: 1 to 7 bytes and the seq, or six bytes of an answer.
      p_length: assert (length_o >= (answer_q ? 4'd6 : 4'd1) && length_o <= 4'd8);
    end
  end
