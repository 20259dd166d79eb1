  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_time_cmp, spliced into it. There is no reset and TIME is any number in every
  // clock; each property is about two clocks, the first of which is any state.

  // TIME of this clock is lo_i of the one before. What is written counts from the next clock on.

  logic        f_reached, f_due, f_ran = 1'b0;
  logic        f_new;                // TCMP was changed in the clock before
  logic        f_calm;               // the parity is right, or about to be taken
  assign f_calm    = gen_watch.changed_q || gen_watch.parity == gen_watch.parity_q;
  logic [31:0] f_time, f_target, f_launch, f_late, f_ahead;
  assign f_late    = f_time - f_target;
  assign f_reached = !f_late[31] && !f_new;
  assign f_ahead   = f_launch - f_time;
  assign f_due     = (f_ahead == 32'd0 || f_ahead > 32'h8000_0000);
  always @(posedge clk_i) begin
    {f_ran, f_time, f_target, f_launch} <= {1'b1, lo_i, target_q, launch_i};
    f_new <= arm_i || fire;
  end

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    if (f_ran) begin
      // TM-30: while armed it fires in every clock with TIME - TCMP >= 0, so in the first; a new
      // TCMP counts a clock later.
      p_fires: assert (fire == (armed_o && enable_i && f_reached));
      // TM-40: a launch is not before its time: at TTX or up to 2^31 ns behind.
      p_launch: assert (launch == (held_o && f_due));
      // TM-40: what stays held is due within 2^31 ns of TIME, from any state.
      p_within: assert (!held_o || launch || f_ahead <= 32'h8000_0000);
      // TM-30, TM-40: both are told in the clock after.
      p_told: assert (match_o == $past(fire) && launch_o == $past(launch));
      // TM-30: once: with a period the next time is that much later, without it is disarmed.
      p_target: assert (target_q == ($past(arm_i) ? $past(data_i)
                        : $past(target_q) + ($past(fire) ? $past(period_i) : 32'd0)));
      // TM-30: armed by a write while CMPEN is 1, disarmed by CMPEN = 0 and by a single event.
      p_armed: assert (armed_o == ($past(enable_i) && ($past(arm_i)
                       || ($past(armed_o) && !($past(fire) && $past(period_i) == 32'd0)))));
      // TM-30, TM-31: the output toggles at each event, or goes to 1; arming clears it.
      p_out: assert (out_o == ($past(arm_i) ? $past(out_o) && !$past(enable_i)
                     : $past(fire) ? $past(period_i) == 32'd0 || !$past(out_o) : $past(out_o)));
      // TM-141: who is right stays so, whatever changes it, and is told nothing.
      p_calm: assert (!$past(f_calm) || (f_calm && upset_o == ($past(upset_o) && !$past(arm_i))));
      // TM-40: a buffer is held from the request until it is due or released, no longer.
      p_held: assert (held_o == ($past(hold_i)
                      || ($past(held_o) && !$past(launch) && !$past(release_i))));
    end
  end
