  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_time_cmp, spliced into it. There is no reset and TIME is any number in every
  // clock; each property is about two clocks, the first of which is any state.

  logic        f_reached, f_due, f_ran = 1'b0;
  logic [31:0] f_ahead, f_late;
  assign f_late    = lo_i - target_q;
  assign f_reached = !f_late[31];
  assign f_ahead   = launch_i - lo_i;
  assign f_due     = f_ahead == 32'd0 || f_ahead > 32'h8000_0000;
  always @(posedge clk_i) f_ran <= 1'b1;

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    // TM-30: while armed it fires in every clock with TIME - TCMP >= 0, so in the first.
    p_fires: assert (match_o == (armed_o && enable_i && f_reached));
    // TM-40: a launch is told in the clock that is due, not before: at TTX or up to 2^31 ns behind.
    p_launch: assert (launch_o == (held_o && f_due));
    // TM-40: what stays held is due within 2^31 ns of TIME, from any state.
    p_within: assert (!held_o || launch_o || f_ahead <= 32'h8000_0000);
    if (f_ran) begin
      // TM-30: once: with a period the next time is that much later, without it is disarmed.
      p_target: assert (target_q == ($past(arm_i) ? $past(data_i)
                        : $past(target_q) + ($past(match_o) ? $past(period_i) : 32'd0)));
      // TM-30: armed by a write while CMPEN is 1, disarmed by CMPEN = 0 and by a single event.
      p_armed: assert (armed_o == ($past(enable_i) && ($past(arm_i)
                       || ($past(armed_o) && !($past(match_o) && $past(period_i) == 32'd0)))));
      // TM-30, TM-31: the output toggles at each event, or goes to 1; arming clears it.
      p_out: assert (out_o == ($past(arm_i) ? $past(out_o) && !$past(enable_i)
                     : $past(match_o) ? $past(period_i) == 32'd0 || !$past(out_o) : $past(out_o)));
      // TM-40: a buffer is held from the request until it is due or released, no longer.
      p_held: assert (held_o == ($past(hold_i)
                      || ($past(held_o) && !$past(launch_o) && !$past(release_i))));
    end
  end
