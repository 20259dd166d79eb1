  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_time_sync, spliced into it: its states (TM-103, TM-104). There is no reset
  // and every register is free; each property is about two clocks, the first of which is any state.

  logic       f_ran = 1'b0;
  logic       f_enable, f_done, f_step, f_far, f_anew, f_last, f_late, f_leap, f_whole;
  logic [1:0] f_state;
  logic [2:0] f_op;
  logic [7:0] f_pairs;
  logic       f_followed;    // a pair has been worked off that was no step
  assign f_followed = f_done && !f_step;
  always @(posedge clk_i) begin
    f_ran <= 1'b1;
    {f_enable, f_done, f_step, f_far, f_anew, f_last, f_late, f_leap}
      <= {enable, done, step, far, anew, last, late, leap_q};
    f_whole <= pps && (upset_i || far || state_q == StNone);
    {f_state, f_op, f_pairs} <= {state_q, op_q, pairs_q};
  end

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    if (f_ran) begin
      // TM-104: EN = 0 is unsynchronised.
      p_off: assert (f_enable || (state_q == StNone && op_q == OpIdle && !leap_q));
      // TM-103, TM-104: the order of the states. LOCKED comes from ACQUIRING alone, HOLDOVER only
      // from who has had a pair.
      p_order: assert ((state_q != StLocked || f_state == StAcquiring || f_state == StLocked)
                       && (state_q != StHoldover || f_state != StNone));
      // TM-103: LOCKED behind twelve pairs at least that are followed; and it comes to that from
      // any number of pairs.
      p_locked: assert (state_q != StLocked || f_state == StLocked
                        || (f_followed && f_pairs >= 8'd11 && f_op == OpTurn));
      p_ends: assert (!(f_enable && f_state == StAcquiring && f_followed && f_pairs >= 8'd11)
                      || state_q == StLocked);
      // TM-103: a step leads to ACQUIRING and its pairs are counted from 0, whatever was before;
      // but with a new increment, one more step is to come.
      p_step: assert (!(f_enable && f_done && f_step && !f_anew)
                      || (state_q == StAcquiring && pairs_q == '0));
      p_anew: assert (!(f_enable && f_done && f_anew)
                      || (state_q == StNone && pairs_q == '0 && f_op == OpTurn));
      p_pairs: assert (pairs_q == (f_done ? (f_step ? '0 : f_pairs + {7'b0, f_pairs != '1})
                                          : f_pairs));
      // TM-104: HOLDOVER when it is late, and no pair is being worked off.
      p_late: assert (state_q != StHoldover || f_state == StHoldover || (f_late && f_op == OpIdle));
      // TM-103: in LOCKED the first pair that is far off does nothing, the second in a row shifts.
      p_ignored: assert (!(f_enable && f_op == OpJudge && f_last && f_state == StLocked && f_far)
                         || (f_leap ? op_q == OpShift : op_q == OpIdle && leap_q));
      // TM-104: of a pair that shifts alone the compare unit hears if it is the first one or far
      // off, or behind an upset; behind a holdover its output goes on.
      p_whole: assert (!(f_enable && f_op == OpShift && f_last && f_step && !f_anew)
                       || op_q == (f_whole ? OpWhole : OpIdle));
      // TM-102: a round is 64 clocks; what it does changes behind its last one alone.
      p_round: assert (!f_enable || f_last || op_q == f_op);
    end
  end
