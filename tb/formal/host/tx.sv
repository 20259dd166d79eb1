  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_mb_tx, spliced into it. There is no reset: they hold from every state.

  // The order of the bus (flexcan.md 3.3), smaller first: a base frame's bits end with IDE = 0.
  function automatic logic [34:0] f_value(input logic [31:0] cs, input logic [31:0] id,
                                          input logic prio);
    logic [2:0] first;
    first = prio ? id[31:29] : 3'd0;
    if (cs[21]) f_value = {first, id[28:18], 1'b1, 1'b1, id[17:0], cs[20]};
    else        f_value = {first, id[28:18], cs[20], 1'b0, 19'd0};
  endfunction

  logic f_ran = 1'b0;
  logic [6:0] f_open = 7'd0;      // clocks that a pass has been under way in calm
  logic f_calm;
  assign f_calm = !cs_written_i && !ans_i && !start_i && !off_i && !inactive_i && !retry_i
               && !sent_i && !freed && !set_aside && running_i
               && ins_gnt_i == ins_req_o && scan_gnt_i == (scan_req_o && !ins_gnt_i);
  always @(posedge clk_i) begin
    f_ran  <= 1'b1;
    f_open <= !f_calm || s3_end || !(scan_q || look_q || quiet_q) || f_open == 7'd127
            ? 7'd0 : f_open + 7'd1;
  end

  logic [39:0] f_cand, f_best, f_best_q, f_cand_q;
  assign f_cand = {lbuf_i ? 35'd0 : val2_q, 1'b0, 4'(idx2_q)};
  assign f_best = {lbuf_i ? 35'd0 : best_val_q, 1'b0, 4'(best_idx_o)};
  logic f_lbuf_q, f_take_q, f_won_q, f_own_q;
  always @(posedge clk_i) begin
    f_cand_q <= f_cand;
    f_best_q <= f_best;
    f_lbuf_q <= lbuf_i;
    f_own_q  <= own_q;
    // Those that a pass for ESR2 looks at are no candidates.
    f_take_q <= running_i && candidate && !look2_q;
    f_won_q  <= best_q;
  end

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    // A slot is given to one that asks (host.native_port, p_slots).
    m_slots: assume ((!ins_gnt_i || ins_req_o) && (!scan_gnt_i || (scan_req_o && !ins_gnt_i)));
    // LBUF is written in freeze mode only (host.regs, p_ctrl1_freeze).
    m_lbuf: assume (!f_ran || lbuf_i == f_lbuf_q);
    if (f_ran) begin
      // flexcan.md 3.3: the arbitration value is that of the order of the bus, with PRIO before it
      // if LPRIO_EN is set.
      p_value: assert (!$past(s1_q) || val2_q == f_value($past(cs_i), $past(id_i),
                                                           $past(lprio_en_i)));
      // flexcan.md 3.3: only codes 1100 and 1110 from the first mailbox to MAXMB take part.
      p_part: assert (!$past(s1_q) || !active2_q
                      || (($past(cs_i[27:24]) == 4'b1100 || $past(cs_i[27:24]) == 4'b1110)
                          && 7'(idx2_q) >= $past(first_i) && 7'(idx2_q) <= $past(maxmb_i)));
      // FX-9.ERR005829: a candidate without a winner becomes the winner.
      p_first: assert (!(f_take_q && !f_won_q) || (best_q && f_best == f_cand_q));
      // FX-9.ERR005829: without a candidate the winner stays as long as nothing touches it, and so
      // does its value while it is said to be there.
      p_stays: assert (!$past(running_i && best_q && !withdrawn && !(candidate && !look2_q))
                       || (best_q && f_best[3:0] == f_best_q[3:0]
                           && (f_best == f_best_q || !f_own_q || !own_q)));
      // FX-9.ERR005829: a winner that is touched makes a pass over all buffers begin.
      p_pass_begins: assert (!$past(running_i && withdrawn && !s3_end) || scan_q);
      // FX-9.ERR005829: so does a C/S write whose insertion another one overtakes.
      p_overtaken: assert (!$past(running_i && ins_q && cs_written_i && !s3_end) || scan_q);
      // FX-9.ERR005829: without a winner a pass begins whenever fresh_i says so.
      p_fresh: assert (!$past(running_i && fresh_i && !best_q && !s3_end)
                       || scan_q || look_q || quiet_q);
      // FX-9.ERR005829: ... and if that meets an active buffer, one that looks for the winner.
      p_found: assert (!$past(running_i && candidate && !best_q && !s3_end
                              && !retry_i && !ins_want)
                       || scan_q || best_q);
      // flexcan.md 3.3: a buffer on the bus is no winner, but in the first clock.
      p_off: assert (!$past(running_i && off_i) || cur_idx_i != $past(cur_idx_i)
                     || !(best_q && best_idx_o == cur_idx_i));
      // FX-9.ERR005829: a winner that is not active is dropped.
      p_dropped: assert (!$past(inactive_i && running_i && !candidate) || !best_q);
    end
    // FX-9.ERR005829: what is compared stands still for two clocks: no read follows another
    // at once.
    p_apart: assert (!(ins_req_o || scan_req_o) || !s1_q);
    // FX-9.ERR005829: a pass ends: in two turns of 16 buffers, from every state.
    p_pass_ends: assert (f_open < 7'd80);
  end
