  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_remote, spliced into it, with any engine and any contents of the RAM: how
  // long user logic waits for the RAM, and that every job ends. The lemmas say how long each job
  // lasts, by the counters that it has (l_phase to l_write), which job follows which, so how many
  // clocks user logic has waited before it (f_most), and who works: a frame that is under way, a
  // request, the visit of a producer or a frame of a block transfer, one at a time (l_one).

  logic f_idle, f_waits, f_user, f_new, f_request, f_renewed;
  can_rn_pkg::job_t f_job;
  logic [6:0] f_len_q, f_len;          // clocks of the present job before this one
  logic [5:0] f_busy, f_before_q, f_before;  // clocks without the RAM until now, until this job
  logic [7:0] f_away;                  // clocks since JobIdle, but those of JobInt2 and JobStart
  logic [1:0] f_begun;                 // how often JobBegin has ended since then
  logic       f_told;                  // JobInt2 has ended since then
  logic [5:0] f_stand;                 // clocks for which the frame has told nothing new
  logic [4:0] f_frame;
  logic [31:0] f_rdata;
  assign f_idle   = job == can_rn_pkg::JobIdle;
  assign f_waits  = f_idle || job == can_rn_pkg::JobStart || job == can_rn_pkg::JobClear;
  assign f_user   = job[5:2] == 4'd0 || job == can_rn_pkg::JobClear;
  assign f_new    = job != f_job;
  assign f_len    = f_new ? 7'd0 : f_len_q;
  assign f_before = f_user ? 6'd0 : f_new ? f_busy : f_before_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_request, f_renewed, f_len_q, f_busy, f_before_q, f_stand, f_frame} <= '0;
      {f_away, f_begun, f_told} <= '0;
      f_job   <= can_rn_pkg::JobClear;
      f_rdata <= '0;
    end else begin
      f_job      <= job;
      f_len_q    <= f_len + {6'd0, !(&f_len)};
      f_busy     <= f_user ? 6'd0 : f_busy + {5'd0, !(&f_busy)};
      f_before_q <= f_before;
      f_request  <= (f_idle && valid) || (f_request && !f_idle);
      f_renewed  <= job == can_rn_pkg::JobRenew || (f_renewed && !f_idle);
      f_away     <= f_waits ? 8'd0
                            : f_away + {7'd0, job != can_rn_pkg::JobInt2 && !(&f_away)};
      f_begun    <= f_waits ? 2'd0 : f_begun + {1'b0, begins && !(&f_begun)};
      f_told     <= !f_waits && (f_told || job == can_rn_pkg::JobInt2);
      f_frame    <= {rx_rtr, rx_dlc};
      f_rdata    <= rdata;
      f_stand    <= take || rx_byte_we || f_frame != {rx_rtr, rx_dlc}
                    ? 6'd0 : f_stand + {5'd0, !(&f_stand)};
    end
  end

  // Clocks without the RAM before a job at most.
  function automatic logic [5:0] f_most(input can_rn_pkg::job_t is);
    case (is)
      can_rn_pkg::JobFetch: f_most = 6'd1;
      can_rn_pkg::JobMove:  f_most = 6'd3;
      can_rn_pkg::JobFresh, can_rn_pkg::JobGuard, can_rn_pkg::JobOpen:
                            f_most = 6'd4;
      can_rn_pkg::JobSame:  f_most = 6'd5;
      can_rn_pkg::JobRenew: f_most = 6'd8;
      can_rn_pkg::JobDown, can_rn_pkg::JobCount: f_most = 6'd12;
      can_rn_pkg::JobPush:  f_most = 6'd15;
      can_rn_pkg::JobGap, can_rn_pkg::JobKeep, can_rn_pkg::JobClose: f_most = 6'd16;
      can_rn_pkg::JobAim:   f_most = 6'd17;
      default:              f_most = 6'd0;
    endcase
  endfunction

  // Clocks since JobIdle at most before those in f_busy.
  logic [7:0] f_spent;
  always_comb begin
    case (f_begun)
      2'd0:    f_spent = job == can_rn_pkg::JobBegin ? 8'd19 + {1'b0, f_len} : 8'd0;
      2'd1:    f_spent = f_user ? 8'd107 : 8'd83;
      default: f_spent = f_user ? 8'd132 : 8'd108;
    endcase
    if (f_told) f_spent = 8'd132;
  end

  // JobMove: first byte of the row, where the bytes end, and where it is; 16 bytes of the stage
  // end with row 0, none with the first step.
  logic [4:0] f_first, f_last, f_row;
  logic       f_stage;
  assign f_stage = trigger || acts;
  assign f_first = f_stage ? 5'd0 : {3'b000, far, data};
  assign f_last  = f_stage ? (StageBytes == 0 ? 5'd1 : 5'(StageBytes)) : {1'b0, row_end};
  assign f_row   = {StageBytes == 16 && f_stage && row == 4'd0 && f_len != 7'd0, row};
  // Round of JobAdd, by the bytes that it works on.
  logic [1:0] f_round;
  assign f_round = block_cell[8:1] == 8'h04 ? 2'd0 : block_cell[8:1] == 8'h07 ? 2'd1
                   : block_cell[8:3] == 6'b000100 ? 2'd2 : 2'd3;
  // Jobs of one clock, those whose phases are their clocks, those beside a frame under way.
  logic f_plain, f_single, f_live_job;
  assign f_single = job == can_rn_pkg::JobHead || job == can_rn_pkg::JobFresh
                    || job == can_rn_pkg::JobPush || job == can_rn_pkg::JobClose;
  assign f_plain = job[4] ? job != can_rn_pkg::JobAdd && job != can_rn_pkg::JobOpen
                          : job == can_rn_pkg::JobByte || job == can_rn_pkg::JobLoad
                            || job == can_rn_pkg::JobAim || job == can_rn_pkg::JobLate
                            || job == can_rn_pkg::JobFetch;
  assign f_live_job = job == can_rn_pkg::JobIdle || job == can_rn_pkg::JobByte
                      || job == can_rn_pkg::JobGuard || job == can_rn_pkg::JobFind
                      || job == can_rn_pkg::JobAim || job == can_rn_pkg::JobHead
                      || job == can_rn_pkg::JobFetch || job == can_rn_pkg::JobLow
                      || job == can_rn_pkg::JobHigh || job == can_rn_pkg::JobAge
                      || job == can_rn_pkg::JobTally;

  // Jobs of requests, of requests and frames that nobody has asked for, of visits to producers, and
  // what a request may begin and end with.
  logic f_asked, f_made, f_visit, f_ends;
  assign f_ends  = job == can_rn_pkg::JobGuard || job == can_rn_pkg::JobClose
                   || job == can_rn_pkg::JobStart || job == can_rn_pkg::JobConfig;
  assign f_asked = job == can_rn_pkg::JobCount || job == can_rn_pkg::JobTrigger
                   || job == can_rn_pkg::JobInt2 || job == can_rn_pkg::JobOpen;
  assign f_made  = job == can_rn_pkg::JobBegin || job == can_rn_pkg::JobMove
                   || job == can_rn_pkg::JobFresh || job == can_rn_pkg::JobPush;
  assign f_visit = job == can_rn_pkg::JobSame || job == can_rn_pkg::JobKeep
                   || job == can_rn_pkg::JobDown || job == can_rn_pkg::JobRenew
                   || job == can_rn_pkg::JobGap;

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    // A frame ends 15 bits or more behind the last thing that it tells.
    m_stand: assume (!(live && (rx_valid || gap)) || (f_stand >= 6'd32 && !rx_byte_we));
    // A header comes while no frame is under way, and is taken long before a byte or the end.
    m_hdr: assume (!rx_hdr || !(live || take));
    m_take: assume (!take || !(gap || rx_valid || rx_byte_we));
    // RTR stands from the header on, and as DLC until the work of the frame is done, long before
    // the next one has a header.
    m_rtr: assume (!live || f_frame[4] == rx_rtr);
    m_frame: assume (f_idle || !f_request || f_frame == {rx_rtr, rx_dlc});
    // JobFind reads each entry twice: the same word.
    m_word: assume (job != can_rn_pkg::JobFind || f_job != can_rn_pkg::JobFind || phase[0]
                    || rdata == f_rdata);
    // What JobRenew has written is not 0, so JobDown, which reads it, does not lead there again.
    m_period: assume (!f_renewed || !visit || job != can_rn_pkg::JobDown || phase != 2'd3
                      || then_job != can_rn_pkg::JobRenew);
    if (rst_ni) begin
      // RN-102 P-8, RN-102 P-9, RN-50: user logic waits for 24 clocks at most.
      p_waits: assert (f_user || f_busy < 6'd24);
      // RN-102 P-8, RN-102 P-9, RN-52: a hold ends.
      p_hold: assert (job != can_rn_pkg::JobBegin || f_len < 7'd64 || (acts && f_len == 7'd64));
      // RN-102 P-9: the work of a request begins once, that of a map entry that acts as a TRIGGER
      // twice.
      p_begin: assert (!begins || f_begun == 2'd0 || (f_begun == 2'd1 && acts));
      // RN-102 P-9: it is over when it has been told, but for the count of such an entry.
      p_over: assert (!f_told || f_waits || job == can_rn_pkg::JobInt2
                      || (job == can_rn_pkg::JobTrigger && mapped));
      // RN-102 P-9: every step leads to the idle step: within 136 clocks and the three sample
      // points of JobInt2, less than 200 with up to 21 clocks a bit.
      p_ends: assert (f_away < 8'd136);

      // How long a job lasts.
      l_phase: assert (!f_plain || f_len == {5'd0, phase});
      l_single: assert (!f_single || (f_len == 7'd0 && phase == 2'd0));
      l_find: assert (job != can_rn_pkg::JobFind
                      || (f_len == {2'd0, row, phase[0]} && row <= 4'(NumMap)));
      l_same: assert (job != can_rn_pkg::JobSame
                      || (f_len == {2'd0, row, phase[0]}
                          && (row == 4'd0 || (row <= row_end && row_end <= 4'd8))));
      l_open: assert (job != can_rn_pkg::JobOpen
                      || (row[0] == (phase == 2'd1) && row <= 4'd10
                          && f_len == {2'd0, row[3:1] - {2'd0, phase[1]}, phase}));
      l_add: assert (job != can_rn_pkg::JobAdd || f_len <= {3'd0, f_round, phase});
      l_read: assert (job != can_rn_pkg::JobMove || !read
                      || (f_row <= f_last && f_row >= f_first && f_last <= 5'd8 + {4'd0, far}
                          && (phase[1] ? f_len == {2'd0, f_row - f_first} + 7'd2 && phase == 2'd2
                                       : f_len == {5'd0, phase} && f_row == f_first)));
      l_write: assert (job != can_rn_pkg::JobMove || read
                       || (f_first < f_last && f_row <= f_last && f_row >= f_first
                           && (&phase ? f_row == f_last
                                        && f_len == {2'd0, f_last - f_first} + 7'd1
                                      : f_len == {2'd0, f_row - f_first}
                                        && phase == {f_len > 7'd1, f_len == 7'd1})));
      l_held: assert (job != can_rn_pkg::JobBegin || acts || f_len == {1'b0, row, phase});

      // Which job follows which, and how many clocks each had before it.
      l_sum: assert (f_user || {1'b0, f_busy} == {1'b0, f_before} + f_len);
      l_order: assert (f_before <= f_most(job));
      l_move: assert (job != can_rn_pkg::JobMove || read || f_stage
                      || (write && f_before == 6'd0 && f_last <= 5'd8));
      l_fresh: assert (job != can_rn_pkg::JobFresh || f_before == 6'd0
                       || (visit && then_job == can_rn_pkg::JobSame));
      l_down: assert (job != can_rn_pkg::JobDown || f_before <= 6'd4 || f_renewed);
      l_count: assert (job != can_rn_pkg::JobCount || f_before == 6'd0 || write);
      l_fetch: assert (job != can_rn_pkg::JobFetch || f_before == 6'd0
                       || (live && f_stand <= f_busy));
      l_row: assert (row == 4'd0 || !(job == can_rn_pkg::JobGap || job == can_rn_pkg::JobDown
                                      || job == can_rn_pkg::JobRenew
                                      || (job == can_rn_pkg::JobGuard && !live && !mapped)
                                      || (job == can_rn_pkg::JobFetch && make && phase[1])));
      l_begun: assert (!(f_asked || job == can_rn_pkg::JobMove || job == can_rn_pkg::JobPush
                         || job == can_rn_pkg::JobSeq || job == can_rn_pkg::JobKeep
                         || (job == can_rn_pkg::JobFresh && f_before == 6'd0))
                       || f_begun != 2'd0);
      l_first: assert (!(job == can_rn_pkg::JobEntry || job == can_rn_pkg::JobGap
                         || job == can_rn_pkg::JobDown || job == can_rn_pkg::JobRenew
                         || job == can_rn_pkg::JobFetch || job == can_rn_pkg::JobGuard)
                       || f_begun == 2'd0);
      l_once: assert (job != can_rn_pkg::JobMove || acts || f_begun == 2'd1);
      l_again: assert (job != can_rn_pkg::JobBegin || f_begun == 2'd0
                       || (f_begun == 2'd1 && acts));
      l_away: assert (f_waits || f_away <= f_spent + {2'd0, f_user ? 6'd0 : f_busy});

      // Who works.
      l_one: assert ({1'b0, visit} + {1'b0, make}
                      + {1'b0, live || has_byte || (f_request && !f_idle)} <= 2'd1);
      l_works: assert (!f_request || f_idle || f_asked || f_made || f_ends);
      l_asked: assert (!f_asked || f_request);
      l_made: assert (!f_made || visit || make || f_request);
      l_visit: assert (!f_visit || visit);
      l_live: assert (!(live || has_byte) || f_live_job);
      l_byte: assert (!has_byte || rx_byte_we || f_stand <= f_busy);
      l_work: assert (!f_request || f_idle || !(live || has_byte));
      l_hdr: assert (!hdr || !live);
      l_head: assert (job != can_rn_pkg::JobHead || (live && f_stand == 6'd0));
      l_guard: assert (job != can_rn_pkg::JobGuard || mapped
                       || (!live && (visit || make || f_request)));

      // What the work is.
      l_reads: assert (!((f_made || job == can_rn_pkg::JobSeq) && (visit || make))
                       || (job == can_rn_pkg::JobFresh && then_job == can_rn_pkg::JobSame)
                       || (read && !trigger && !acts && (make || code == can_rn_pkg::CodeOk)));
      l_length: assert (!make || f_idle || (job == can_rn_pkg::JobFetch && !phase[1])
                        || (op[3:0] != 4'd0 && op[3:0] <= 4'd8));
      l_make: assert (!make || f_idle || (port && !sys && a[2:1] == 2'b01));
      l_mapped: assert (!mapped || !(live || (f_request && !f_idle)) || !(port || sys));
      l_taken: assert (!mapped || !(live || (f_request && !f_idle)) || !rx_rtr);
      l_search: assert (job != can_rn_pkg::JobFind || !(sys || (live && rx_rtr)));
      l_port: assert (port == ((&a[AddrBits-1:3]) && !sys));
    end
  end
