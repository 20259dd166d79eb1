  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_mode, spliced into it. There is no reset here: they hold from every content
  // of the flip-flops, also after an upset; f_ran is 0 in the first clock only.

  logic f_ran = 1'b0;
  always @(posedge clk_i) f_ran <= 1'b1;

  // What MCR and the system ask for (flexcan.md 2): disable before stop before freeze.
  logic f_low, f_want_disable, f_want_stop, f_want_freeze, f_want_run;
  assign f_want_disable = mdis_i;
  assign f_want_stop    = !mdis_i && stop_req_i && !woken_q;
  assign f_want_freeze  = !mdis_i && !f_want_stop && freeze_i;
  assign f_want_run     = !mdis_i && !f_want_stop && !freeze_i;
  assign f_low          = f_want_disable || f_want_stop;

  // The clocks before this one in which the engine has stopped and the buffers are quiet, up to
  // three: that long the last things it has told them may need to show.
  logic [1:0] f_quiet = 2'd0;
  logic [2:0] f_age = 3'd0;
  always @(posedge clk_i) begin
    f_quiet <= running_i || busy_i ? 2'd0 : f_quiet == 2'd3 ? 2'd3 : f_quiet + 2'd1;
    f_age   <= f_age == 3'd4 ? 3'd4 : f_age + 3'd1;
  end
  logic f_stopped;
  assign f_stopped = !running_i && !busy_i && f_quiet == 2'd3;

  logic f_stopped_now;
  assign f_stopped_now = !running_i && !busy_i;

  // Nothing holds the way to the wish up: on the bus, no frame is hurt; off it, the engine has
  // stopped and the buffers are quiet. How long that may take is the engine's and the buffers'
  // matter; not proven here.
  logic f_free, f_there;
  logic [2:0] f_wait = 3'd0;
  assign f_free  = !scrub_i && !soft_rst_i
                && (run_o ? stop_ok_i || (f_low && !transmitter_i) : f_stopped);
  assign f_there = (f_want_disable && disabled_o) || (f_want_stop && stop_o)
                || (f_want_freeze && frz_ack_o) || (f_want_run && run_o);
  logic f_same;
  logic [3:0] f_wish = 4'd0;
  assign f_same = f_wish == {f_want_disable, f_want_stop, f_want_freeze, f_want_run};
  always @(posedge clk_i) begin
    f_wish <= {f_want_disable, f_want_stop, f_want_freeze, f_want_run};
    f_wait <= f_there || !f_free || !f_same ? 3'd0 : f_wait + 3'd1;
  end

  // Clocks that a soft reset has lasted although engine and buffers were quiet.
  logic [1:0] f_reset_q = 2'b00;
  always @(posedge clk_i) f_reset_q <= {f_reset_q[0] && soft_rst_o, soft_rst_o && f_stopped};

  always @(posedge clk_i) begin
    // No reset.
    m_no_reset: assume (rst_ni);
    // FX-MCR.NOT_RDY, flexcan.md 2: at most one of normal operation, freeze, disable, stop and soft
    // reset; LPM_ACK is disable or stop.
    p_one_mode: assert ($countones({run_o, frz_ack_o, disabled_o, stop_o, soft_rst_o}) <= 1
                        && lpm_ack_o == (disabled_o || stop_o));
    // flexcan.md 2.1, 2.2: a wish that stands is fulfilled in five clocks in which nothing holds
    // it up, from every state.
    p_acknowledged: assert (f_wait <= 3'd5);
    // flexcan.md 2.3: a soft reset ends two clocks after engine and buffers are quiet.
    p_reset_ends: assert (!f_reset_q[1] || !soft_rst_o);
    // FX-MCR.SOFT_RST: everything is cleared only in a soft reset, off the bus ...
    p_clear_off: assert (!clear_o || (soft_rst_o && !run_o));
    if (f_ran) begin
      // FX-9.ERR008341: an illegal state is left in one clock ...
      p_legal: assert (state_q <= StStop);
      // FX-9.ERR008341: ... into a soft reset.
      p_illegal_resets: assert ($past(state_q <= StStop) || soft_rst_o);
      // FX-MCR.SOFT_RST: ... for one clock, the first behind one of the soft reset in which the
      // engine had stopped, which nobody lets run, and the buffers were quiet.
      p_clear: assert (!clear_o || $past(soft_rst_o && !run_o && !clear_o && f_stopped_now));
      // FX-MCR.SOFT_RST: no soft reset without it.
      p_cleared: assert (!$past(soft_rst_o) || soft_rst_o || $past(clear_o));
      // flexcan.md 2.3: between request and acknowledge of a soft reset never on the bus; it ends
      // in freeze mode.
      p_reset_to_freeze: assert (!$past(soft_rst_o) || soft_rst_o || frz_ack_o);
      // flexcan.md 2.3: a soft reset asked for out of low power begins at once.
      p_reset_begins: assert (!$past(soft_rst_i && (run_o || frz_ack_o)) || soft_rst_o);
      // flexcan.md 2.1: a soft reset is not accepted in low power.
      p_no_reset_asleep: assert (!$past(lpm_ack_o) || !soft_rst_o);
      // FX-MCR.FRZ_ACK: nobody gets onto the bus who is not wanted there.
      p_run_wanted: assert (!run_o || $past(run_o) || $past(f_want_run));
      // flexcan.md 2.1, 2.2: acknowledged, and cleared, only after the last moves; once the
      // counter is no longer what an upset has left.
      p_settles: assert (f_age < 3'd4 || !$past(state_q == StHalt || state_q == StReset)
                         || state_q == StHalt || state_q == StReset || $past(f_stopped));
      // flexcan.md 2.2: freeze is left in the next clock when nothing asks for it.
      p_freeze_left: assert (!$past(frz_ack_o && f_want_run && !soft_rst_i) || run_o);
      // flexcan.md 2.2: the bus is left for a wish only, and not in a frame that would be hurt.
      p_leaves_unhurt: assert (!$past(run_o && !soft_rst_i) || run_o
                               || ($past(!f_want_run) && $past(stop_ok_i || f_low)));
      // flexcan.md 2.1: low power hurts no frame that this node sends.
      p_sends_on: assert (!$past(run_o && !soft_rst_i && transmitter_i && !stop_ok_i) || run_o);
      // flexcan.md 2.9: the request counts again only after it has gone away.
      p_woken: assert (woken_q == ($past(stop_req_i) && ($past(woken_q) || $past(wake_i))));
    end
  end
