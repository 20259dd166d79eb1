// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_cmp: the two units that wait for a time: compare unit with output (TM-30, TM-31), and
// launch of one held buffer (TM-40). Both compare 32 bits: a time is reached if it is at most 2^31
// ns ago.

module can_time_cmp #(
  /// 1: upset_o is built, for a follower whose pulses no software supervises; 0: it is 0.
  parameter int Watch = 0
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic [31:0] lo_i,        // TIME[31:0] of the next clock
  input  logic [31:0] data_i,      // TCMP, with arm_i
  // Compare.
  input  logic        enable_i,    // TCTRL.CMPEN; 0 disarms
  input  logic        arm_i,       // pulse: TCMP is written
  input  logic [31:0] period_i,    // TCMPH: ns between events; 0: a single event
  output logic        armed_o,     // an event is pending
  output logic        match_o,     // pulse in the clock after an event
  output logic        out_o,       // toggles in the clock of match_o; TCMPH = 0: goes to 1
  output logic        upset_o,     // state has changed by an upset; until arm_i (TM-141)
  // Launch.
  input  logic        hold_i,      // pulse: the buffer is held from the next clock on
  input  logic        release_i,   // pulse: the buffer is released
  input  logic [31:0] launch_i,    // TTX: launch time
  output logic        held_o,      // the buffer is held
  output logic        launch_o     // pulse in the clock after: launch time is reached
);
  // Distance to each time minus 1. Its sign is registered, so it is known in the clock of TIME
  // itself (TM-18). A target that has changed in the clock before is not compared yet. Both
  // subtractions share the inverted time.
  logic [31:0] target_q, minus_time, to_target, to_launch;
  logic        once, fire, launch, reached_q, due_q;
  assign minus_time = ~lo_i;
  assign to_target  = target_q + minus_time;
  assign to_launch  = launch_i + minus_time;
  assign once       = period_i == '0;
  assign fire       = armed_o && enable_i && reached_q;
  assign launch     = held_o && due_q;

  logic unused;
  assign unused = &{1'b0, to_target[30:0], to_launch[30:0]};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      target_q <= '0;
      {armed_o, out_o, held_o, match_o, launch_o, reached_q, due_q} <= '0;
    end else begin
      if (arm_i) begin
        target_q <= data_i;
        armed_o  <= enable_i;
        if (enable_i) out_o <= 1'b0;
      end else begin
        if (fire) begin
          target_q <= target_q + period_i;
          out_o    <= once || !out_o;
        end
        armed_o <= armed_o && enable_i && !(fire && once);
      end
      held_o    <= hold_i || (held_o && !launch && !release_i);
      reached_q <= to_target[31] && !arm_i && !fire;
      due_q     <= to_launch[31];
      match_o   <= fire;
      launch_o  <= launch;
    end
  end

  // TM-141: a target or output that an upset has changed would shift all later events. Their parity
  // is stored after each regular change and must hold until the next one.
  if (Watch != 0) begin : gen_watch
    logic parity, parity_q, changed_q, upset_q;
    assign parity  = ^{target_q, armed_o, out_o};
    assign upset_o = upset_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        {parity_q, changed_q, upset_q} <= '0;
      end else begin
        changed_q <= arm_i || fire || (armed_o && !enable_i);
        if (changed_q) parity_q <= parity;
        upset_q   <= !arm_i && (upset_q || (!changed_q && parity != parity_q));
      end
    end
  end else begin : gen_no_watch
    assign upset_o = 1'b0;
  end
endmodule
