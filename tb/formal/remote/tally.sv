  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_tally, spliced into it: any events, any jobs, any content of the RAM.

  // JobTally reads in its first phase and writes in its third; then it is over.
  logic       f_ran, f_end;
  logic [1:0] f_phase;
  assign f_end = tally && phase_i == 2'd2;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_ran, f_phase} <= '0;
    else begin
      f_ran   <= 1'b1;
      f_phase <= tally && !f_end ? phase_i + 2'd1 : 2'd0;
    end
  end

  // What has happened and is not counted yet, by the table of RN-35; an answer that was dropped, a
  // hold that was too long, and what CLEAR asks for: its first word, its second.
  logic       f_due, f_drop, f_over, f_rest;
  assign f_rest = f_end && !f_due && f_clear == 2'd0;
  logic [2:0] f_what;
  logic [1:0] f_clear;
  logic [2:0] f_counter;
  always_comb begin
    case (code_i)
      can_rn_pkg::CodeFunction: f_counter = 3'd0;
      can_rn_pkg::CodeValue:    f_counter = 3'd1;
      can_rn_pkg::CodeBusy:     f_counter = 3'd3;
      can_rn_pkg::CodeAddress, can_rn_pkg::CodeProtected, can_rn_pkg::CodeLocked:
                                f_counter = 3'd2;
      default:                  f_counter = 3'd6;
    endcase
  end
  logic f_one, f_bad_order;
  assign f_bad_order = job_i == can_rn_pkg::JobTrigger && phase_i == 2'd0 && !none_i && !order_q;
  assign f_one = counted || f_bad_order || dup_i || off_entry_i || timeout_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_due, f_drop, f_over} <= '0;
      f_what  <= '0;
      f_clear <= '0;
    end else begin
      if (f_one) begin
        f_due  <= 1'b1;
        f_what <= dup_i ? 3'd4 : off_entry_i ? 3'd5 : f_bad_order || timeout_i ? 3'd6
                  : f_counter;
      end else if (f_end && f_clear == 2'd0) f_due <= 1'b0;
      if (clear_i)    f_clear <= 2'd2;
      else if (f_end) f_clear <= f_clear == 2'd0 ? 2'd0 : f_clear - 2'd1;
      if (dropped_i)  f_drop <= 1'b1;
      else if (f_rest) f_drop <= 1'b0;
      if (over_i)     f_over <= 1'b1;
      else if (f_rest && !f_drop) f_over <= 1'b0;
    end
  end

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    // JobTally begins when it is asked for and has three phases.
    m_phase: assume (!tally || (want_o && phase_i == f_phase));
    m_whole: assume (f_phase == 2'd0 || tally);
    m_idle: assume (!$past(f_end) || !tally);
    // One thing at a time, and the next when the last has been counted; but for a hold and answers
    // that are dropped, which do not happen in the midst of JobTally.
    m_one: assume ($countones({counted, f_bad_order, dup_i, off_entry_i, timeout_i, clear_i}) <= 1);
    m_apart: assume (!(f_one || clear_i) || (!tally && !f_due && f_clear == 2'd0));
    m_hold: assume (!(over_i || dropped_i) || !tally);
    // A refused request has a code, and none of those that only answers of BLOCK have.
    m_code: assume (!counted || code_i == can_rn_pkg::CodeFunction
                    || code_i == can_rn_pkg::CodeValue || code_i == can_rn_pkg::CodeAddress
                    || code_i == can_rn_pkg::CodeBusy || code_i == can_rn_pkg::CodeProtected
                    || code_i == can_rn_pkg::CodeLocked || code_i == can_rn_pkg::CodeSequence);
    if (f_ran) begin
      // RN-35: nothing that happens is forgotten, and nothing else is counted.
      p_want: assert (want_o == (f_due || f_drop || f_over || f_clear != 2'd0));
      // RN-35: each thing is counted where it belongs.
      p_counter: assert (!(f_end && f_due && f_clear == 2'd0) || cell_o == 9'h1E8 + 9'(f_what));
      // RN-35: an answer that is dropped is counter 3,
      p_dropped: assert (!(f_rest && f_drop) || cell_o == 9'h1EB);
      // RN-35: a hold too long counter 7.
      p_hold: assert (!(f_rest && !f_drop) || cell_o == 9'h1EF);
      // RN-35: one more is counted, not when CLEAR writes.
      p_one_more: assert (!f_end || more_o == (f_clear == 2'd0));
      // RN-102 P-12, RN-35: a counter of 255 is not written but by CLEAR.
      p_no_wrap: assert (!(tally && last) || byte_i != 8'hFF || no_write_o);
      // RN-35: nor does anything else keep one from counting.
      p_counts: assert (!(tally && last) || byte_i == 8'hFF || !no_write_o);
      // RN-35: CLEAR writes both words whole, with a byte that is 0.
      p_clear: assert (!(tally && f_clear != 2'd0)
                       || (wide_o && (last ? cell_o[8:2] == {6'b1_1110_1, f_clear == 2'd1}
                                           : cell_o == 9'h006)));
      // RN-35: no other write is of a whole word.
      p_wide: assert (!wide_o || (tally && f_clear != 2'd0));
    end
  end
