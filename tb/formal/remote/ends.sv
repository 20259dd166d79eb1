// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_step and can_rn_move as profile small has them, with any frames and any answers of the
// other blocks: how long user logic waits, and that every job ends. A request goes through JobBegin
// (64 clocks at most), jobs that have the RAM (24) and JobInt2 (three sample points, step.p_ends)
// back to JobIdle: less than 200 clocks, with up to 25 clocks a bit.

module ends (
  input logic       clk,
  input logic       rst_n,
  input logic       hdr, ours, has_byte, live, valid, tick, dup, key,
  input logic       refused, write, read, trigger, nothing, restart, operate, hold,
  input logic       carry, ms, boff, off, try_due, load, urgent, some, more, gone, feed, tally,
  input logic       start, run, far, info, data,
  input logic [3:0] dlc,
  input logic [2:0] count,
  input logic [6:0] a
);
  can_rn_pkg::job_t job;
  logic [1:0] phase;
  logic [3:0] row;
  logic       request, begins, take, ended;

  // The clearing is one clock, as where InitFile replaces it.
  can_rn_step u_step (
    .clk_i(clk), .rst_ni(rst_n),
    .hdr_i(hdr), .ours_i(ours), .byte_i(has_byte), .live_i(live), .valid_i(valid), .tick_i(tick),
    .dup_i(dup), .key_i(key), .refused_i(refused), .write_i(write), .read_i(read),
    .trigger_i(trigger), .nothing_i(nothing), .restart_i(restart), .operate_i(operate),
    .hold_i(hold), .ended_i(ended), .cleared_i(1'b1), .row_i(row), .carry_i(carry), .ms_i(ms),
    .boff_i(boff), .off_i(off), .try_i(try_due), .load_i(load), .urgent_i(urgent), .some_i(some),
    .more_i(more), .gone_i(gone), .owe_feed_i(feed), .tally_i(tally), .start_i(start), .run_i(run),
    .want_i(1'b0), .visit_i(1'b0), .then_i(can_rn_pkg::JobIdle), .same_i(1'b0),
    .begun_i(can_rn_pkg::JobIdle), .fetch_i(1'b0), .block_i(1'b0),
    .block_job_i(can_rn_pkg::JobIdle), .opens_i(1'b0), .ends_i(1'b0), .on_i(1'b0), .closes_i(1'b0),
    .search_i(1'b0), .find_i(1'b0), .hit_i(1'b0), .mapped_i(1'b0), .act_i(1'b0), .again_i(1'b0),
    .watch_i(1'b0), .job_o(job), .phase_o(phase), .timer_o(), .request_o(request),
    .begin_o(begins), .over_o(), .take_o(take), .ten_o(), .new_tries_o(), .written_o(), .apply_o()
  );
  can_rn_move u_move (
    .clk_i(clk), .rst_ni(rst_n),
    .job_i(job), .phase_i(phase), .request_i(request), .begin_i(begins), .take_i(take),
    .read_i(read), .trigger_i(trigger), .stage_i(trigger), .far_i(far), .info_i(info),
    .data_i(data), .load_i(1'b0), .answer_i(1'b0), .key_i(key), .crosses_i(1'b0), .find_i(1'b0),
    .act_i(1'b0), .aim_i(1'b0), .aim_at_i('0), .a_i(a), .dlc_i(dlc), .count_i(count),
    .byte_i('0), .start_o(), .mem_o(), .place_o(), .row_o(row), .end_o(), .ended_o(ended),
    .staged_o(), .cleared_o()
  );

  // Jobs in which user logic has the RAM (port.p_alone).
  logic free, clearing, idle;
  assign idle     = job == can_rn_pkg::JobIdle;
  assign clearing = job == can_rn_pkg::JobClear;
  assign free     = idle || job == can_rn_pkg::JobBegin || job == can_rn_pkg::JobInt2
                    || job == can_rn_pkg::JobStart;

  // Clocks in a row in which user logic has not the RAM; in JobBegin.
  logic [4:0] f_busy;
  logic [6:0] f_held;
  logic       f_ran;
  always_ff @(posedge clk or negedge rst_n) begin
    if (!rst_n) begin
      {f_busy, f_held, f_ran} <= '0;
    end else begin
      f_ran  <= 1'b1;
      f_busy <= free || clearing ? 5'd0 : f_busy + {4'd0, !(&f_busy)};
      f_held <= job != can_rn_pkg::JobBegin ? 7'd0 : f_held + {6'd0, !(&f_held)};
    end
  end

  always @(posedge clk) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_n == !$initstate);
    // A request stays what it is until its work is over, and has eight bytes at most: can_rn_head
    // keeps it, can_rn_check refuses it otherwise.
    m_same: assume (!f_ran || idle || $past(idle)
                    || {refused, write, read, trigger, nothing, restart, operate, far, data, dlc,
                        count, a} == $past({refused, write, read, trigger, nothing, restart,
                                            operate, far, data, dlc, count, a}));
    m_kind: assume ({1'b0, read} + {1'b0, write} + {1'b0, trigger} <= 2'd1);
    m_length: assume (dlc <= 4'd8 && count <= 3'd6);
    if (f_ran) begin
      // RN-102 P-8, RN-102 P-9, RN-50: user logic waits for 24 clocks at most.
      p_waits: assert (f_busy < 5'd24 || free || clearing);
      l_held: assert (job != can_rn_pkg::JobBegin || f_held == {1'b0, row, phase});
      // RN-102 P-8, RN-102 P-9, RN-52: a hold ends.
      p_hold: assert (f_held < 7'd64 || job != can_rn_pkg::JobBegin);
      // RN-102 P-9: a request begins once, and is over when it has been told.
      p_begin: assert (job != can_rn_pkg::JobBegin
                       || $past(idle || job == can_rn_pkg::JobBegin));
      p_over: assert (!$past(job == can_rn_pkg::JobInt2) || job == can_rn_pkg::JobInt2 || idle);
    end
  end
endmodule
