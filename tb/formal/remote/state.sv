  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_state, spliced into it: any order of jobs, any request, any byte of the
  // RAM. No reset: they hold from every content of the flip-flops, also after an upset; f_ran is 0
  // in the first clock alone.

  logic f_ran = 1'b0;
  always @(posedge clk_i) f_ran <= 1'b1;

  logic f_state_command, f_auto;
  assign f_state_command = counts_q && !refused_i && state_i && op_i[1:0] == 2'b01 && !op_i[2];
  assign f_auto          = (begins && byte_i[3]) || (off_exit_i && auto_q)
                           || (told_i && auto_q && !unsafe_i);

  // No watchdog and no STATE 02 since STATE 01 or the start.
  logic f_may;
  always @(posedge clk_i) begin
    if (expired || to_safe)              f_may <= 1'b0;
    else if (!run_o || f_state_command) f_may <= 1'b1;
  end

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    // What was before the first clock only the flip-flop tells.
    m_may: assume (f_ran || f_may == may_q);
    // SETUP has ops 1 to 4: can_rn_head tells others, and can_rn_check refuses them.
    m_op: assume (!(act && setup_i) || (op_i[2] ? op_i[1:0] == 2'b00 : op_i[1:0] != 2'b00));
    // RN-07, RN-102 P-5: no STATUS without a number.
    p_numbered: assert (!owe_status_o || number_o > NameBits'(1));
    // RN-72, RN-102 P-5: off the bus everything that waits is forgotten.
    p_flush: assert (run_o || flush_o);
    if (f_ran) begin
      // RN-70, RN-102 P-10: into OPERATE by STATE or AUTO_OP alone.
      p_operate: assert (!operate_o || $past(operate_o) || $past(f_state_command || f_auto));
      // RN-70: a watchdog that has expired ends it.
      p_watchdog: assert (!$past(run_o && expired) || !operate_o);
      // RN-66, RN-70: so does a map entry that has waited too long.
      p_stale: assert (!$past(run_o && told_i && unsafe_i) || !operate_o);
      // RN-70, RN-72: so does bus-off.
      p_bus_off: assert (!$past(run_o && off_entry_i) || !operate_o);
      // RN-70: AUTO_OP does not undo the watchdog or STATE 02.
      p_may: assert (!$past(run_o) || !operate_o || $past(operate_o || f_state_command || f_may));
      // RN-70: but it does return after bus-off where neither has been.
      p_auto: assert (!$past(run_o && off_exit_i && auto_q && f_may && node_q[1] && !off_entry_i
                             && !expired && !to_safe && !unsafe_i) || operate_o);
      // RN-70, RN-102 P-11: an illegal code leads to SAFE.
      p_illegal: assert (!$past(run_o && !node_o[1]) || node_o == can_rn_pkg::NodeSafe || !run_o
                         || $past(begins));
      // RN-61: OPERATE, however entered, locks.
      p_locks: assert (!$past(operate_o) || !unlocked_o);
      // RN-61: only UNLOCK, and only one that is not refused, opens.
      p_unlock: assert (!unlocked_o || $past(unlocked_o)
                        || $past(counts_q && !refused_i && setup_i && op_i[1:0] == 2'b01));
      // RN-61: locked until reset is for good.
      p_for_good: assert (!$past(lock_reset_o) || lock_reset_o);
      // RN-35, RN-24: flags are cleared by CLEAR alone.
      p_flags: assert ((status_o & $past(status_o) & 8'hD0) == ($past(status_o) & 8'hD0)
                       || $past(counts_q && !refused_i && setup_i && op_i[2]));
      // RN-11: a statement under the own number is noticed.
      p_dup: assert (!$past(dup_i) || status_o[4]);
      // RN-26: a node with a number does not obey SELECT NEW.
      p_new: assert (!$past(accept_i && select_i && new_i && numbered_o) || !selected_o);
      // RN-60: the number changes by ASSIGN or at the start alone.
      p_number: assert (number_o == $past(number_o)
                        || $past((counts_q && !refused_i && assign_i)
                                 || job_i == can_rn_pkg::JobConfig));
    end
  end
