  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_tx, spliced into it: any order of jobs, any content of the RAM.

  // f_asked: a frame was offered in the clock before; an engine that takes it says so in this one.
  // f_recalled: HERE has been taken back in the clock before or in this one.
  logic f_ran, f_sending, f_asked, f_owed, f_recall_q, f_recalled;
  assign f_recalled = f_recall_q || (f_owed && !owe_here_i && !gone_here_o && !flush_i);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_ran, f_sending, f_asked, f_owed, f_recall_q} <= '0;
    else begin
      f_ran     <= 1'b1;
      f_asked   <= tx_req_o;
      f_owed    <= owe_here_i && !gone_here_o;
      f_recall_q <= f_owed && !owe_here_i && !gone_here_o && !flush_i;
      f_sending <= (f_sending || tx_next_i) && !tx_ok_i && !tx_fail_i;
    end
  end

  // The phase of JobAge that comes next; 0: none.
  logic [1:0] f_aging;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_aging <= '0;
    else         f_aging <= job_i == can_rn_pkg::JobAge ? phase_i + 2'd1 : 2'd0;
  end

  // The phase of JobLoad that comes next; 0: none.
  logic [1:0] f_loading;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_loading <= '0;
    else         f_loading <= job_i == can_rn_pkg::JobLoad && !phase_i[1] ? phase_i + 2'd1 : 2'd0;
  end

  // The phase of JobTry that comes next; 0: none.
  logic [1:0] f_trying;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_trying <= '0;
    else         f_trying <= job_i == can_rn_pkg::JobTry && !phase_i[1] ? phase_i + 2'd1 : 2'd0;
  end

  // A frame for this node is or was under way, and its work is done when JobLoad begins.
  logic f_work;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_work <= 1'b0;
    else         f_work <= live_i || (f_work && job_i != can_rn_pkg::JobLoad);
  end

  // Answers that wait: what has been pushed and has not gone.
  logic [2:0] f_fill;
  assign f_fill = 3'(PtrWidth'(tail_q - head_q));

  logic f_here;
  assign f_here = tx_word_o[28:18] == 11'h402 && tx_dlc_o == 4'd0;

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    // A frame is taken when one is offered (AR-13), and ends after that.
    m_taken: assume (!tx_next_i || f_sending || f_asked);
    m_ends: assume (!(tx_ok_i || tx_fail_i) || f_sending);
    // An error in the last bit before a byte: it is asked for, and the attempt has failed.
    m_one_end: assume (!tx_ok_i || !(tx_next_i || tx_fail_i));
    // can_rn_check refuses a read for which there is no room (can_remote, node.p_no_overflow).
    m_room: assume (job_i != can_rn_pkg::JobPush || !full_o);
    // What is flushed is not under way: RESTART, ASSIGN and bus-off come when nothing is sent.
    m_flush: assume (!flush_i || (!f_sending && !tx_next_i && !tx_ok_i));
    m_flushed: assume (!$past(flush_i) || !tx_next_i);
    // JobTry and JobAge begin when they are asked for, JobLoad when there is something to load.
    m_load: assume (job_i != can_rn_pkg::JobLoad || phase_i != 2'd0
                    || some_o || owe_status_i || owe_here_i);
    m_try: assume (job_i != can_rn_pkg::JobTry || (!f_sending && !tx_next_i && !flush_i));
    // Nor is HERE taken back: a SELECT is obeyed before the intermission behind it ends (RN-37).
    m_here: assume (!(f_sending || tx_next_i) || !f_recalled);
    // From a failed attempt to the next are 17 bits at least, many times what JobTry waits for.
    m_pause: assume (!tx_next_i || f_sending
                     || !(try_q || f_trying != 2'd0 || $past(f_trying) != 2'd0));
    m_tried: assume (job_i != can_rn_pkg::JobTry || phase_i != 2'd0 || try_q);
    // No job writes the queue while it is flushed.
    m_flush_alone: assume (!flush_i || (job_i != can_rn_pkg::JobPush
                                        && job_i != can_rn_pkg::JobLoad));
    // JobAge has four phases.
    m_age: assume (job_i != can_rn_pkg::JobAge || phase_i == f_aging);
    m_age_ends: assume (f_aging == 2'd0 || job_i == can_rn_pkg::JobAge);
    // JobTry and JobLoad have three.
    m_tries: assume (job_i != can_rn_pkg::JobTry || phase_i == f_trying);
    m_try_ends: assume (f_trying == 2'd0 || job_i == can_rn_pkg::JobTry);
    m_loads: assume (job_i != can_rn_pkg::JobLoad || phase_i == f_loading);
    m_load_ends: assume (f_loading == 2'd0 || job_i == can_rn_pkg::JobLoad);
    if (f_ran) begin
      // RN-102 P-4, RN-10, RN-11: an identifier that is sent has dir 1 and the own number, or is
      // HERE.
      p_own_id: assert (!tx_req_o || f_here
                        || tx_word_o[28:18] >> AddrBits == {1'b1, number_i});
      // RN-52: the engine, which then shows DLC and RTR of its own frame, is offered none before.
      p_withdrawn: assert (!f_work || !tx_req_o);
      // RN-80: what is offered is what has been loaded for it, in all three phases.
      p_chosen: assert (f_loading != 2'd1 || load_q || src_q != can_rn_pkg::SrcNone);
      p_length: assert (f_loading == 2'd1 || load_q || !header_q || !own
                        || length_q == {2'b00, !src_q[0], 3'd0});
      p_loaded: assert (f_loading != 2'd0 || load_q || !header_q
                        || (src_q != can_rn_pkg::SrcNone && (!own || hold_q == 8'(own_a))));
      // RN-54: what the engine takes is still there, even if its life ends in that clock.
      p_taken: assert (!tx_next_i || f_sending
                       || (src_q != can_rn_pkg::SrcNone && src_q == $past(src_q)));
      // RN-54: and stays until its end.
      p_stays: assert (!$past((f_sending || tx_next_i) && !tx_ok_i && !tx_fail_i && !flush_i)
                       || (src_q == $past(src_q) && head_q == $past(head_q)));
      // RN-54: the life that is written is that which was read, of one answer.
      p_same_answer: assert (job_i != can_rn_pkg::JobAge || phase_i == 2'd0 || $past(flush_i)
                             || age_o == $past(age_o));
      // RN-15: an attempt that has failed is one of what is offered.
      p_tried: assert (!try_q || src_q != can_rn_pkg::SrcNone);
      // RN-102 P-3, RN-54: nothing goes that is not there.
      p_no_underflow: assert (head_q == $past(head_q) || $past(flush_i || some_o));
      // RN-31, RN-102 P-3: full is told exactly when no more can be taken.
      p_full: assert (full_o == (f_fill == 3'(TxDepth)));
    end
  end
