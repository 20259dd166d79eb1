  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_produce, spliced into it: any order of jobs, any entries.

  logic f_ran;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_ran <= 1'b0;
    else         f_ran <= 1'b1;
  end

  logic f_gap_over;
  assign f_gap_over = job_i == can_rn_pkg::JobGap && zero_i;

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    if (f_ran) begin
      // RN-63: what user logic wants is due, whatever else happens.
      p_event: assert ((due_q & $past(event_i)) == $past(event_i) || $past(forget_i));
      // RN-72: bus-off and RESTART forget what is due.
      p_forget: assert (!$past(forget_i) || due_q == '0);
      // RN-64: due stays due until its statement is made, or it may not be sent.
      p_due: assert ((due_q & $past(due_q)) == $past(due_q) || $past(forget_i)
                     || $past(job_i == can_rn_pkg::JobFresh)
                     || $past(job_i == can_rn_pkg::JobGap && (refused_i || !operate_i)));
      // RN-63: an entry that is off is not due but for an event; nor are data outside OPERATE.
      p_off: assert ((due_q & ~$past(due_q) & ~$past(event_i)) == '0
                     || $past(!refused_i && (operate_i || info_i)));
      // RN-64: with something in the queue, or off the bus, no statement is begun.
      p_closed: assert (!(want_o && pass_q == PassSend) || !closed_i);
      // RN-45: and what is done for one never tells user logic of a write.
      p_then: assert (then_o == can_rn_pkg::JobIdle || then_o == can_rn_pkg::JobBegin
                      || then_o == can_rn_pkg::JobFresh || then_o == can_rn_pkg::JobMove
                      || then_o == can_rn_pkg::JobSame || then_o == can_rn_pkg::JobGap
                      || then_o == can_rn_pkg::JobKeep || then_o == can_rn_pkg::JobDown
                      || then_o == can_rn_pkg::JobRenew);
      // RN-63: nor within the gap, nor for an entry that may not be sent.
      p_gap: assert (then_o != can_rn_pkg::JobBegin
                     || (f_gap_over && !refused_i && (operate_i || info_i)));
    end
  end
