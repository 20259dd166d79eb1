// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_step: sequencer of can_remote (RN-36, RN-37). It chooses the next job and steps through
// its phases. A request comes before all other work. Between the header of a frame for this node
// and its end only timers, ageing and counters may begin (JobLow or JobHigh, JobAge, JobTally), one
// behind each sample point, so that they end before the next one.

module can_rn_step #(
  parameter bit Map = 1'b0,
  parameter bit Protect = 1'b0,
  parameter bit Block = 1'b0
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  // Frame
  input  logic             hdr_i,         // a received header waits
  input  logic             ours_i,        // waiting header: the frame concerns this node
  input  logic             byte_i,        // a received data byte waits
  input  logic             live_i,        // a frame for this node is under way
  input  logic             valid_i,       // that frame is valid; until the sequencer is idle
  input  logic             tick_i,        // pulse: sample point
  // Request
  input  logic             dup_i,         // frame is a statement under the own number (RN-11)
  input  logic             key_i,         // JobByte: byte is compared, which takes four phases
  input  logic             refused_i,     // request is refused
  input  logic             write_i,       // request writes the memory
  input  logic             read_i,        // request reads: an answer is made
  input  logic             trigger_i,     // request is TRIGGER, or JobMove copies the stage
  input  logic             nothing_i,     // valid request needs no work
  input  logic             restart_i,     // accepted request is RESTART
  input  logic             operate_i,     // node is in OPERATE
  input  logic             hold_i,        // user logic holds (RN-52)
  // Mover and data
  input  logic             ended_i,       // mover has reached the end of the bytes
  input  logic             cleared_i,     // JobClear: last address is reached
  input  logic [3:0]       row_i,         // byte of the row; JobBegin: bits 5:2 of its clocks
  input  logic             carry_i,       // JobLow: JobHigh follows
  // Other work
  input  logic             ms_i,          // pulse: millisecond
  input  logic             boff_i,        // engine is in bus-off
  input  logic             off_i,         // bus-off as noted by the last JobTurn
  input  logic             try_i,         // a failed attempt is to be counted
  input  logic             load_i,        // engine needs its next word
  input  logic             urgent_i,      // engine needs a data byte within eight bits
  input  logic             some_i,        // queue of answers is not empty
  input  logic             more_i,        // JobAge: another answer has to age
  input  logic             gone_i,        // pulse: frame offered to the engine sent or dropped
  input  logic             owe_feed_i,    // watchdog is to be reloaded
  input  logic             tally_i,       // JobTally is due
  input  logic             start_i,       // node may join the bus
  input  logic             run_i,         // node is on the bus
  // Producers
  input  logic             want_i,        // an entry is to be visited
  input  logic             visit_i,       // entry is visited, or a block transfer makes a frame
  input  can_rn_pkg::job_t then_i,        // next job while visit_i
  input  logic             same_i,        // JobSame continues
  input  can_rn_pkg::job_t begun_i,       // next job after JobBegin while visit_i
  // Block transfers
  input  logic             fetch_i,       // DATA: JobHead is followed by JobFetch
  input  logic             block_i,       // block_job_i is due
  input  can_rn_pkg::job_t block_job_i,   // job of a block transfer
  input  logic             opens_i,       // JobCount: BLOCK opens a transfer
  input  logic             ends_i,        // JobCount: refused DATA frame ends the write
  input  logic             on_i,          // JobAdd continues
  input  logic             closes_i,      // JobAdd is followed by JobClose
  // Map entries
  input  logic             search_i,      // waiting header: a map entry may take the frame
  input  logic             find_i,        // JobFind continues
  input  logic             hit_i,         // JobFind has found an entry
  input  logic             mapped_i,      // frame is taken by a map entry
  input  logic             act_i,         // that entry acts as a TRIGGER
  input  logic             again_i,       // its copy of the stage begins or is under way
  input  logic             watch_i,       // JobLate is due
  output can_rn_pkg::job_t job_o,         // present job
  output logic [1:0]       phase_o,       // phase of the job
  output logic             timer_o,       // timer of JobLow, JobHigh: 0: watchdog, 1: bus-off
  output logic             request_o,     // pulse: a request is valid
  output logic             begin_o,       // pulse: work of a request or visit begins
  output logic             over_o,        // pulse: a hold has lasted too long (RN-52)
  output logic             take_o,        // pulse: waiting header is taken over
  output logic             ten_o,         // pulse: every 10 ms
  output logic             new_tries_o,   // JobRow: attempts are reloaded from RETRY
  output logic             written_o,     // pulse: a write is in the RAM (RN-45)
  output logic             apply_o        // pulse: staged bytes are visible (RN-45)
);
  // Keep the encoding: unused codes, reached by an upset, then lead back to JobIdle.
  (* fsm_encoding = "none", syn_encoding = "safe" *) can_rn_pkg::job_t job_q;
  can_rn_pkg::job_t job_d, work, next;
  logic [1:0] phase_q, int2_q;
  logic [3:0] ten_q;
  logic       tick_q, timer_q, high_q, ms_q, aged_q, row_ready_q, try_ready_q;
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
  // written_o and apply_o pulse in the clock after the sample point. JobInt2 ends one clock later,
  // which keeps the sample point out of the path that chooses the next job.
  assign int2      = int2_q == 2'd0 ? !(written_o || apply_o) : int2_q == 2'd1 && tick_i;
  assign held      = hold_i && !refused_i && (memory || trigger_i || act_i);
  assign over      = (&row_i) && (&phase_q);
  assign wait_user = held && !over && !again_i;
  assign over_o    = job_q == can_rn_pkg::JobBegin && held && over && !visit_i && !again_i;
  assign begin_o   = job_q == can_rn_pkg::JobBegin && !wait_user;

  // Job after JobIdle: what a frame or a timer asks for comes first (soon), then the rest (later).
  logic             front;
  can_rn_pkg::job_t soon, later;
  assign front = valid_i || hdr_i || byte_i || (quiet && urgent_i)
                 || (due && (tally_i || ms_q || aged_q));
  always_comb begin
    soon = can_rn_pkg::JobAge;
    // JobGuard, JobBegin or, for a statement, nothing. A map entry has had its JobGuard already.
    if (valid_i) soon = {1'b0, guarded, 1'b0, {2{guarded}}, !dup_i};
    else if (hdr_i)               soon = {2'b00, ours_i || search_i, search_i, 2'b00};
    else if (byte_i)              soon = can_rn_pkg::JobByte;
    else if (quiet && urgent_i)   soon = can_rn_pkg::JobLoad;
    else if (tally_i)             soon = can_rn_pkg::JobTally;
    else if (ms_q)                soon = high_q ? can_rn_pkg::JobHigh : can_rn_pkg::JobLow;
  end
  always_comb begin
    later = can_rn_pkg::JobIdle;
    // RN-103: only an upset leads here while the node is off the bus.
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

  // First job of a request that is not refused.
  assign work   = nothing_i ? can_rn_pkg::JobIdle : trigger_i ? can_rn_pkg::JobTrigger
                  : read_i ? can_rn_pkg::JobFresh : write_i ? can_rn_pkg::JobMove
                                                            : can_rn_pkg::JobCount;
  assign memory = write_i || read_i;

  // A map entry that acts as a TRIGGER copies the stage after its frame's bytes (OPERATE only),
  // starting with JobBegin like a request. JobTrigger comes last: the count follows both pulses.
  can_rn_pkg::job_t moved, told;
  assign told  = act_i ? can_rn_pkg::JobTrigger : can_rn_pkg::JobIdle;
  assign moved = act_i && operate_i && !again_i ? can_rn_pkg::JobBegin : can_rn_pkg::JobInt2;

  // keep: the job continues with its next phase; otherwise job_d follows.
  always_comb begin
    keep  = job_q[4] && !(phase_q[1] && (phase_q[0] || !job_q[3]));
    job_d = can_rn_pkg::JobIdle;
    case (job_q)
      can_rn_pkg::JobBegin: begin
        keep  = wait_user;
        job_d = refused_i ? can_rn_pkg::JobCount : work;
      end
      // RN-103: after an upset that takes the node off the bus there are no sample points.
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
        // The DLC follows the header, so the last address is known only with the first byte.
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
    // A frame that nobody has requested gives way to a request and to the engine.
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
      {timer_q, high_q, ms_q, aged_q, row_ready_q, try_ready_q} <= '0;
    end else begin
      // ten_q passes 10 of the 15 states of x^4 + x + 1: 1, 2, 4, 8, 3, 6, 12, 11, 5, 10.
      if (ms_i) ten_q <= ten_q == 4'd10 ? 4'd1
                                        : {ten_q[2], ten_q[1], ten_q[0] ^ ten_q[3], ten_q[3]};
      timer_q     <= timer_q ^ ended_timer;
      // The high byte is counted behind another sample point: before the last phase of a JobByte
      // that waited for both, the engine could have received the next bit but one of 5 clocks.
      high_q      <= (job_q == can_rn_pkg::JobLow && phase_q[1] && carry_i)
                     || (high_q && job_q != can_rn_pkg::JobHigh);
      ms_q        <= ms_i || (ms_q && !(ended_timer && timer_q));
      aged_q      <= ten_o || (aged_q && some_i && (job_q != can_rn_pkg::JobAge || more_i
                                                          || !(&phase_q)));
      row_ready_q <= job_q == can_rn_pkg::JobRow
                     || (row_ready_q && job_q != can_rn_pkg::JobPush);
      try_ready_q <= !gone_i && (try_ready_q || (job_q == can_rn_pkg::JobRow && (&phase_q)));
    end
  end

  // INT2 has the third sample point after that of EOF6, where the frame is valid.
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
