// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_step: the order of work: what to do next, and how long. A request comes before everything
// else; nothing else begins between its header and its end but timers, right behind a sample
// point: they are over before the next one.

module can_rn_step #(
  parameter bit Map = 1'b0,
  parameter bit Protect = 1'b0,
  parameter bit Block = 1'b0
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  // Frame
  input  logic             hdr_i,         // a header waits
  input  logic             ours_i,
  input  logic             byte_i,        // a byte waits
  input  logic             live_i,        // a frame for this node is under way
  input  logic             valid_i,       // it is valid
  input  logic             tick_i,        // sample point
  // Request
  input  logic             dup_i,
  input  logic             key_i,
  input  logic             refused_i,
  input  logic             write_i,
  input  logic             read_i,
  input  logic             trigger_i,
  input  logic             nothing_i,     // nothing more to do for it
  input  logic             restart_i,
  input  logic             operate_i,
  input  logic             hold_i,
  // Mover and data
  input  logic             ended_i,
  input  logic             cleared_i,
  input  logic [3:0]       row_i,
  input  logic             carry_i,       // JobLow: the high byte counts
  // What else there is to do
  input  logic             ms_i,
  input  logic             boff_i,
  input  logic             off_i,         // bus-off, as far as it has been noticed
  input  logic             try_i,
  input  logic             load_i,        // the engine has to be given something,
  input  logic             urgent_i,      // within eight bits
  input  logic             some_i,
  input  logic             more_i,        // JobAge: another answer has aged
  input  logic             gone_i,        // what was offered to the engine
  input  logic             owe_feed_i,
  input  logic             tally_i,       // something has happened that is counted
  input  logic             start_i,
  input  logic             run_i,
  // Producers
  input  logic             want_i,        // an entry is to be looked at
  input  logic             visit_i,       // this is being done
  input  can_rn_pkg::job_t then_i,        // what follows the present job then
  input  logic             same_i,        // JobSame goes on
  input  can_rn_pkg::job_t begun_i,       // what follows JobBegin then
  // Block transfers
  input  logic             fetch_i,       // this frame goes on with one: JobHead is followed
  input  logic             block_i,       // something is to be done for one
  input  can_rn_pkg::job_t block_job_i,   // by this
  input  logic             opens_i,       // JobCount: one is opened
  input  logic             ends_i,        // or ended by a frame that is refused
  input  logic             on_i,          // JobAdd goes on
  input  logic             closes_i,      // and the transfer is closed then
  // Map entries
  input  logic             search_i,      // a header that one may take waits
  input  logic             find_i,        // JobFind goes on
  input  logic             hit_i,         // and has found one
  input  logic             mapped_i,      // the frame is taken by one
  input  logic             act_i,         // as a TRIGGER, too,
  input  logic             again_i,       // whose copy begins or is under way
  input  logic             watch_i,       // a time-out is to be looked at
  output can_rn_pkg::job_t job_o,
  output logic [1:0]       phase_o,
  output logic             timer_o,
  output logic             request_o,     // a request is valid
  output logic             begin_o,       // its work begins
  output logic             over_o,        // pulse: the hold has lasted too long (RN-52)
  output logic             take_o,        // header is taken over
  output logic             ten_o,         // 10 ms have passed
  output logic             new_tries_o,   // JobRow: the attempts count from the start
  output logic             written_o,     // pulses for user logic (RN-45)
  output logic             apply_o
);
  // As written here, so that codes of no job lead back.
  (* fsm_encoding = "none", syn_encoding = "safe" *) can_rn_pkg::job_t job_q;
  can_rn_pkg::job_t job_d, work, next;
  logic [1:0] phase_q, int2_q;
  logic [3:0] ten_q;
  logic       tick_q, timer_q, ms_q, aged_q, row_ready_q, try_ready_q;
  logic       guarded, memory, keep, idle, held, over, wait_user, quiet, due, int2, ended_timer;

  assign job_o   = job_q;
  assign phase_o = phase_q;
  assign timer_o = timer_q;
  assign new_tries_o = !try_ready_q;

  assign guarded   = Protect && !dup_i && !mapped_i && memory;
  assign idle      = job_q == can_rn_pkg::JobIdle;
  assign quiet     = !live_i;
  assign due       = quiet || tick_q;
  assign request_o = idle && valid_i && !dup_i;
  assign take_o    = idle && hdr_i;
  assign ten_o     = ms_i && ten_q == 4'd1;
  // Told in the clock behind the sample point; the job ends one later, so that the sample point
  // does not lead through what comes next.
  assign int2      = int2_q == 2'd0 ? !(written_o || apply_o) : int2_q == 2'd1 && tick_i;
  assign held      = hold_i && !refused_i && (memory || trigger_i || act_i);
  assign over      = (&row_i) && (&phase_q);
  assign wait_user = held && !over && !again_i;
  assign over_o    = job_q == can_rn_pkg::JobBegin && held && over && !visit_i && !again_i;
  assign begin_o   = job_q == can_rn_pkg::JobBegin && !wait_user;

  // What comes next when nothing is under way: what a frame or the time asks for, else the rest.
  logic             front;
  can_rn_pkg::job_t soon, later;
  assign front = valid_i || hdr_i || byte_i || (quiet && urgent_i)
                 || (due && (tally_i || ms_q || aged_q));
  always_comb begin
    soon = can_rn_pkg::JobAge;
    // What a map entry takes has been looked at before. JobGuard, JobBegin, or nothing.
    if (valid_i) soon = {1'b0, guarded, 1'b0, {2{guarded}}, !dup_i};
    else if (hdr_i)               soon = {2'b00, ours_i || search_i, search_i, 2'b00};
    else if (byte_i)              soon = can_rn_pkg::JobByte;
    else if (quiet && urgent_i)   soon = can_rn_pkg::JobLoad;
    else if (tally_i)             soon = can_rn_pkg::JobTally;
    else if (ms_q)                soon = can_rn_pkg::JobLow;
  end
  always_comb begin
    later = can_rn_pkg::JobIdle;
    // RN-103: nothing leads here with the node off the bus but an upset.
    if (!run_i)                            later = can_rn_pkg::JobStart;
    else if (try_i)                        later = can_rn_pkg::JobTry;
    else if (load_i)                       later = can_rn_pkg::JobLoad;
    else if (!row_ready_q || !try_ready_q) later = can_rn_pkg::JobRow;
    else if (boff_i ^ off_i)               later = can_rn_pkg::JobTurn;
    else if (owe_feed_i)                   later = can_rn_pkg::JobFeed;
    else if (Block && block_i)             later = block_job_i;
    else if (watch_i)                      later = can_rn_pkg::JobLate;
    else if (want_i)                       later = can_rn_pkg::JobEntry;
  end
  assign next = front ? soon : later & {6{quiet}};

  // What a request leads to that is not refused.
  assign work   = nothing_i ? can_rn_pkg::JobIdle : trigger_i ? can_rn_pkg::JobTrigger
                  : read_i ? can_rn_pkg::JobFresh : write_i ? can_rn_pkg::JobMove
                                                            : can_rn_pkg::JobCount;
  assign memory = write_i || read_i;

  // A frame that acts as a TRIGGER in OPERATE is followed by the copy of the stage, which begins
  // like a request. User logic is told of both; they have to be over by then, so that the TRIGGER
  // is counted last.
  can_rn_pkg::job_t moved, told;
  assign told  = act_i ? can_rn_pkg::JobTrigger : can_rn_pkg::JobIdle;
  assign moved = act_i && operate_i && !again_i ? can_rn_pkg::JobBegin : can_rn_pkg::JobInt2;

  // keep: the job goes on with its next phase; else it is followed by job_d.
  always_comb begin
    keep  = job_q[4] && !(phase_q[1] && (phase_q[0] || !job_q[3]));
    job_d = can_rn_pkg::JobIdle;
    case (job_q)
      can_rn_pkg::JobBegin: begin
        keep  = wait_user;
        job_d = refused_i ? can_rn_pkg::JobCount : work;
      end
      // RN-103: an upset that takes the node off the bus leaves no sample points to wait for.
      can_rn_pkg::JobInt2:  keep = int2_q != 2'd0 && run_i;
      can_rn_pkg::JobGuard: if (Protect) begin
        keep  = !(&phase_q);
        job_d = can_rn_pkg::JobBegin;
      end
      can_rn_pkg::JobStart: begin
        keep  = run_i || !start_i;
        job_d = can_rn_pkg::JobConfig;
      end
      can_rn_pkg::JobByte:  keep = key_i && !(&phase_q);
      can_rn_pkg::JobMove: begin
        keep  = read_i ? !(ended_i && phase_q[1]) : !(&phase_q);
        job_d = read_i ? can_rn_pkg::JobPush : trigger_i ? can_rn_pkg::JobInt2
                                                         : can_rn_pkg::JobCount;
      end
      can_rn_pkg::JobClear: begin
        keep  = !cleared_i;
        job_d = can_rn_pkg::JobStart;
      end
      can_rn_pkg::JobLoad:  keep = !phase_q[1];
      can_rn_pkg::JobFresh:   job_d = can_rn_pkg::JobMove;
      can_rn_pkg::JobTrigger: if (operate_i) job_d = can_rn_pkg::JobMove;
      can_rn_pkg::JobLow:     if (carry_i) job_d = can_rn_pkg::JobHigh;
      can_rn_pkg::JobCount: begin
        if (restart_i)                  job_d = can_rn_pkg::JobStart;
        else if (!refused_i && write_i) job_d = can_rn_pkg::JobInt2;
      end
      default: ;
    endcase
    if (Block) begin
      case (job_q)
        can_rn_pkg::JobHead:  if (fetch_i) job_d = can_rn_pkg::JobFetch;
        can_rn_pkg::JobFetch: keep = !(&phase_q);
        can_rn_pkg::JobCount: begin
          if (opens_i) job_d = can_rn_pkg::JobOpen;
          if (ends_i)  job_d = can_rn_pkg::JobClose;
        end
        can_rn_pkg::JobOpen:  keep = !((&phase_q) && row_i[3] && row_i[1]);
        can_rn_pkg::JobAdd: begin
          keep = on_i;
          if (closes_i) job_d = can_rn_pkg::JobClose;
        end
        default: ;
      endcase
    end
    // Map entries
    if (mapped_i) begin
      case (job_q)
        // With the first byte the length is known, which comes behind the header.
        can_rn_pkg::JobByte:    if (Protect && row_i == 4'd0) job_d = can_rn_pkg::JobGuard;
        can_rn_pkg::JobGuard:   job_d = can_rn_pkg::JobIdle;
        can_rn_pkg::JobBegin:   job_d = refused_i ? can_rn_pkg::JobIdle
                                        : write_i || again_i ? can_rn_pkg::JobMove
                                        : operate_i && act_i ? can_rn_pkg::JobBegin : told;
        can_rn_pkg::JobMove:    job_d = moved;
        can_rn_pkg::JobInt2:    job_d = told;
        can_rn_pkg::JobTrigger: job_d = can_rn_pkg::JobIdle;
        default: ;
      endcase
    end
    if (Map) begin
      case (job_q)
        can_rn_pkg::JobFind: begin
          keep = find_i;
          if (hit_i) job_d = can_rn_pkg::JobAim;
        end
        can_rn_pkg::JobAim:  keep = !phase_q[0];
        can_rn_pkg::JobLate: keep = !(&phase_q);
        default: ;
      endcase
    end
    // The answer that nobody has asked for gives way to a request, and to the engine.
    if (visit_i) begin
      if (job_q == can_rn_pkg::JobSame)  keep = same_i;
      if (job_q == can_rn_pkg::JobBegin) begin
        keep  = wait_user && !(hdr_i || urgent_i);
        job_d = hdr_i || urgent_i ? can_rn_pkg::JobIdle : begun_i;
      end else if (job_q != can_rn_pkg::JobMove) begin
        job_d = then_i;
      end
    end
    if (idle) job_d = next;
  end

  assign ended_timer = (job_q == can_rn_pkg::JobLow && phase_q[1] && !carry_i)
                       || (job_q == can_rn_pkg::JobHigh && phase_q[1]);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      job_q   <= can_rn_pkg::JobClear;
      phase_q <= '0;
    end else begin
      if (!keep) job_q <= job_d;
      if (!keep) phase_q <= '0;
      else if (job_q == can_rn_pkg::JobMove && phase_q != 2'd0)
                 phase_q <= {1'b1, ended_i && !read_i};
      else       phase_q <= phase_q + 2'd1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ten_q <= 4'd1;
      {timer_q, ms_q, aged_q, row_ready_q, try_ready_q} <= '0;
    end else begin
      // 10 of the 15 states of x^4 + x + 1: 1, 2, 4, 8, 3, 6, 12, 11, 5, 10.
      if (ms_i) ten_q <= ten_q == 4'd10 ? 4'd1
                                        : {ten_q[2], ten_q[1], ten_q[0] ^ ten_q[3], ten_q[3]};
      timer_q     <= timer_q ^ ended_timer;
      ms_q        <= ms_i || (ms_q && !(ended_timer && timer_q));
      aged_q      <= ten_o || (aged_q && some_i && (job_q != can_rn_pkg::JobAge || more_i
                                                          || !(&phase_q)));
      row_ready_q <= job_q == can_rn_pkg::JobRow
                     || (row_ready_q && job_q != can_rn_pkg::JobPush);
      try_ready_q <= !gone_i && (try_ready_q || (job_q == can_rn_pkg::JobRow && (&phase_q)));
    end
  end

  // The third sample point from the end of a valid frame is that of INT2.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      int2_q <= '0;
      tick_q <= 1'b0;
      {written_o, apply_o} <= '0;
    end else begin
      tick_q <= tick_i;
      if (valid_i)                         int2_q <= 2'd3;
      else if (tick_i && int2_q != 2'd0)   int2_q <= int2_q - 2'd1;
      written_o <= job_q == can_rn_pkg::JobInt2 && int2 && write_i;
      apply_o   <= job_q == can_rn_pkg::JobInt2 && int2 && trigger_i && (operate_i || !mapped_i);
    end
  end

endmodule
