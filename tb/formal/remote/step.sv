  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_step, spliced into it: any frames, any answers of the other blocks.

  // Sample points since a frame was valid, and whether it has been told.
  logic [1:0] f_ticks;
  logic       f_shown, f_ran;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      f_ticks <= '0;
      {f_shown, f_ran} <= '0;
    end else begin
      f_ran <= 1'b1;
      if (valid_i)     f_ticks <= '0;
      else if (tick_i) f_ticks <= f_ticks + {1'b0, !(&f_ticks)};
      f_shown <= !valid_i && (f_shown || written_o || apply_o);
    end
  end

  // What may begin while a frame for this node is under way.
  logic f_timer;
  assign f_timer = job_q == can_rn_pkg::JobLow || job_q == can_rn_pkg::JobHigh
                   || job_q == can_rn_pkg::JobAge || job_q == can_rn_pkg::JobTally;

  // What is done for an entry, or a frame of a block transfer, once it may be sent.
  logic f_made;
  assign f_made = job_q == can_rn_pkg::JobBegin || job_q == can_rn_pkg::JobMove
                  || job_q == can_rn_pkg::JobPush || job_q == can_rn_pkg::JobSeq;

  // What is done for a frame that a map entry has taken.
  logic f_mapped;
  assign f_mapped = valid_i || job_q == can_rn_pkg::JobByte || job_q == can_rn_pkg::JobGuard
                    || job_q == can_rn_pkg::JobBegin || job_q == can_rn_pkg::JobMove
                    || job_q == can_rn_pkg::JobInt2 || job_q == can_rn_pkg::JobTrigger;

  logic f_visit, f_visiting;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_visiting <= 1'b0;
    else         f_visiting <= job_q == can_rn_pkg::JobEntry || (f_visiting && !idle)
                               || (Block && job_q == can_rn_pkg::JobFetch && !live_i);
  end
  // The same for a frame of a block transfer.
  logic f_block, f_begun;
  assign f_block = Block && (then_i == can_rn_pkg::JobGuard || then_i == can_rn_pkg::JobMove);
  assign f_begun = begun_i == can_rn_pkg::JobFresh
                   || (Block && (begun_i == can_rn_pkg::JobMove || begun_i == can_rn_pkg::JobSeq
                                 || begun_i == can_rn_pkg::JobClose));
  assign f_visit = then_i == can_rn_pkg::JobFresh || then_i == can_rn_pkg::JobMove
                   || then_i == can_rn_pkg::JobSame || then_i == can_rn_pkg::JobGap
                   || then_i == can_rn_pkg::JobKeep || then_i == can_rn_pkg::JobDown
                   || then_i == can_rn_pkg::JobRenew;

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    // A frame is valid at a sample point, one clock behind it; the next is far away.
    m_valid: assume (!(valid_i && tick_i));
    // One kind of request, the same until it has been told; none while the one before is at work,
    // but it may wait for the end of a timer (head.p_waits).
    m_kind: assume (!(write_i && trigger_i) || mapped_i);
    m_apart: assume (!valid_i || idle || f_timer || !live_i);
    m_waits: assume (!f_ran || !$past(valid_i && !idle) || valid_i);
    // What an entry of a producer leads to (produce.p_then), and that it asks as a read does.
    m_then: assume (then_i == can_rn_pkg::JobIdle || then_i == can_rn_pkg::JobBegin || f_visit
                    || f_block);
    m_begun: assume (f_begun);
    m_read: assume (!visit_i || !f_made || (read_i && !write_i && !trigger_i));
    // What a block transfer is due for.
    m_block: assume (!Block || block_job_i == can_rn_pkg::JobFetch
                     || block_job_i == can_rn_pkg::JobClock
                     || block_job_i == can_rn_pkg::JobAdd || block_job_i == can_rn_pkg::JobClose);
    // It begins with JobEntry or JobFetch and ends where a job is followed by none.
    m_visit: assume (visit_i == f_visiting);
    // A map entry takes no read, and nothing but a header or a visit changes whether one has taken
    // the frame (map.p_mapped). While the header of the next frame comes in, read_i may be that of
    // it already, but not while the frame that was taken is worked on.
    m_mapped: assume (!mapped_i || (!visit_i && (!read_i || !f_mapped)));
    m_taken: assume (!f_ran || mapped_i == $past(mapped_i) || visit_i || $past(visit_i)
                     || $past(idle || job_q == can_rn_pkg::JobFind));
    if (f_ran) begin
      // RN-102 P-7, RN-45: what became visible is told at the third sample point or later.
      p_int2: assert (!(written_o || apply_o) || f_ticks == 2'd3 || $past(valid_i));
      // RN-102 P-7, RN-46, RN-65: never as both, but for a frame that a map entry makes a TRIGGER.
      p_one_kind: assert (!(written_o && apply_o) || $past(mapped_i));
      // RN-102 P-7: and once.
      p_once: assert (!(written_o || apply_o) || !f_shown || $past(valid_i));
      // RN-102 P-9, RN-103: a node that an upset has taken off the bus starts anew.
      p_rejoins: assert (!$past(idle && quiet && !run_i && !valid_i && !hdr_i && !byte_i && !ms_q
                                && !aged_q && !tally_i && !urgent_i)
                       || job_q == can_rn_pkg::JobStart);
      // RN-102 P-9, RN-103: off the bus it waits for no sample point.
      p_no_wait: assert (!$past(job_q == can_rn_pkg::JobInt2 && !run_i)
                         || job_q != can_rn_pkg::JobInt2);
      // RN-102 P-9: a request does not wait for a fourth sample point to be told.
      p_ends: assert (!$past(job_q == can_rn_pkg::JobInt2 && f_ticks == 2'd3)
                      || job_q != can_rn_pkg::JobInt2);
      // RN-102 P-7, RN-45: only for a request that writes, or for TRIGGER.
      p_asked: assert (!written_o || $past(write_i, 1) || $past(write_i, 2));
    end
  end
